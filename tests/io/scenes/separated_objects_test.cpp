// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/separated_objects.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/boost/graph/helpers.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/mesh/errors.h"
#include "support/gltf_samples.h"
#include "support/message_of.h"
#include "support/moving_mesh_files.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Separated_objects : public testing::Test {
 protected:
  /// Two tetrahedra in one mesh, of which the second in the order of vertices moves.
  Scene_object pair(const std::string& name = "pair") const {
    write_two_tetrahedra_in_one_mesh(folder.path() / name, 3);
    return read_object(name,
                       (folder.path() / (name + ".off")).string() + '+' + (folder.path() / (name + ".pc2")).string());
  }
  /// A scene of two such meshes, a and b.
  Scene two_pairs() const {
    Scene scene;
    scene.name = "pairs";
    scene.objects.push_back(pair("a")), scene.objects.push_back(pair("b"));
    return scene;
  }
  /// Faces that share no vertex.
  Scene_object chips(const std::string& name, int faces) const {
    std::string vertices, triangles;
    for (int face = 0; face < faces; ++face) {
      vertices += fmt::format("{0} 0 0\n{0} 1 0\n{0} 0 1\n", face);
      triangles += fmt::format("3 {} {} {}\n", 3 * face, 3 * face + 1, 3 * face + 2);
    }
    const auto header = fmt::format("OFF\n{} {} 0\n", 3 * faces, faces);
    return read_object(name, folder.write(name + ".off", header + vertices + triangles));
  }
  static std::vector<std::string> names(const std::vector<Scene_object>& objects) {
    std::vector<std::string> names;
    for (const auto& object : objects) names.push_back(object.name);
    return names;
  }

  Temporary_folder folder;
};

TEST_F(Separated_objects, components_are_in_the_order_of_their_first_faces_and_move_as_their_part_of_the_whole_does) {
  auto objects = separated_objects(pair(), Separate::components);
  ASSERT_EQ(names(objects), (std::vector<std::string>{"pair_1", "pair_2"}));
  EXPECT_EQ(objects[0].file_face, (std::vector<std::uint32_t>{0, 5, 6, 7}));
  EXPECT_EQ(objects[1].file_face, (std::vector<std::uint32_t>{1, 2, 3, 4}));
  for (const std::size_t frame : {2, 0, 1})
    for (auto& object : objects) {
      pose(object, frame);
      EXPECT_EQ(object.file_vertices, 4U);
      EXPECT_TRUE(CGAL::is_closed(object.mesh));
      const double x = object.name == "pair_1" ? 2.5 - static_cast<double>(frame) : 0;
      EXPECT_EQ(CGAL::Polygon_mesh_processing::bbox(object.mesh), CGAL::Bbox_3(x, 0, 0, x + 1, 1, 1)) << frame;
    }
}

TEST_F(Separated_objects, pose_the_whole_once_per_frame) {
  Scene_object whole = pair();
  const auto poses = std::make_shared<int>(0);
  whole.motion.pose = [poses, inner = whole.motion.pose](std::size_t frame, std::span<Point> positions) {
    ++*poses;
    inner(frame, positions);
  };
  auto objects = separated_objects(whole, Separate::components);
  for (std::size_t frame = 0; frame < 3; ++frame)
    for (auto& object : objects) pose(object, frame);
  EXPECT_EQ(*poses, 3);
}

TEST_F(Separated_objects, a_frame_that_cannot_be_read_is_tried_again_by_each) {
  Scene_object whole = pair();
  const auto is_broken = std::make_shared<bool>(false);
  whole.motion.pose = [is_broken, inner = whole.motion.pose](std::size_t frame, std::span<Point> positions) {
    inner(frame, positions);
    if (*is_broken) throw Bad_motion("broken");
  };
  auto objects = separated_objects(whole, Separate::components);
  const auto expect_pose = [&](std::size_t frame, double x) {
    for (auto& object : objects) pose(object, frame);
    EXPECT_EQ(CGAL::Polygon_mesh_processing::bbox(objects[0].mesh).xmin(), x);
  };
  expect_pose(0, 2.5);
  *is_broken = true;
  for (auto& object : objects) EXPECT_THROW(pose(object, 1), Bad_motion);
  *is_broken = false;
  expect_pose(0, 2.5);
  expect_pose(1, 1.5);
}

TEST_F(Separated_objects, compute_the_positions_that_they_are_posed_to) {
  std::ofstream(folder.path() / "scene.json") << R"({"frames": 4, "objects": [{"name": "both", "mesh": "pair.off",
    "motion": {"deform": [{"twist": {"axis": [1, 2, 3], "degrees": 90, "period": 4}}]}}]})";
  write_two_tetrahedra_in_one_mesh(folder.path() / "pair", 1);
  Scene scene = read_scene(folder.path() / "scene.json");
  separate(scene, Separate::components);
  ASSERT_EQ(scene.objects.size(), 2U);
  for (auto& object : scene.objects) {
    ASSERT_TRUE(object.motion.computed);
    const auto computed = object.motion.computed(object.file_vertex);
    for (std::size_t frame = 0; frame < 4; ++frame) {
      pose(object, frame);
      computed->set_frame(frame);
      std::vector<double> positions(3 * object.mesh.number_of_vertices());
      computed->pose_all(positions);
      for (const auto v : object.mesh.vertices())
        EXPECT_EQ(object.mesh.point(v), Point(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
    }
  }
}

TEST_F(Separated_objects, take_the_place_of_the_whole_with_its_groups_and_the_pairs_that_it_ignores) {
  Scene scene = two_pairs();
  scene.objects[0].collision = {.groups = 2, .meets = 3};
  scene.ignored = {{0, 1}};
  separate(scene, Separate::components);
  ASSERT_EQ(names(scene.objects), (std::vector<std::string>{"a_1", "a_2", "b_1", "b_2"}));
  EXPECT_EQ(scene.objects[1].collision.groups, 2U);
  EXPECT_EQ(scene.objects[1].collision.meets, 3U);
  const std::vector<Object_pair> ignored{{0, 2}, {0, 3}, {1, 2}, {1, 3}};
  EXPECT_EQ(scene.ignored, ignored);
}

TEST_F(Separated_objects, an_object_that_is_not_to_meet_itself_stays_as_it_is) {
  Scene scene = two_pairs();
  scene.ignored = {{0, 0}};
  scene.objects[1].collision = {.groups = 2, .meets = 1};
  separate(scene, Separate::components);
  EXPECT_EQ(names(scene.objects), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(scene.ignored, (std::vector<Object_pair>{{0, 0}}));
}

TEST_F(Separated_objects, an_object_of_one_component_stays_as_it_is) {
  Scene scene = two_pairs();
  auto parts = separated_objects(scene.objects[1], Separate::components);
  scene.objects[1] = std::move(parts[1]);
  scene.ignored = {{0, 1}};
  separate(scene, Separate::components);
  EXPECT_EQ(names(scene.objects), (std::vector<std::string>{"a_1", "a_2", "b_2"}));
  EXPECT_EQ(scene.ignored, (std::vector<Object_pair>{{0, 2}, {1, 2}}));
}

TEST_F(Separated_objects, a_name_that_is_taken_gets_a_number) {
  Scene scene = two_pairs();
  scene.objects[1].name = "a_2";
  separate(scene, Separate::components);
  EXPECT_EQ(names(scene.objects), (std::vector<std::string>{"a_1", "a_2", "a_2_1", "a_2_2"}));
}

TEST_F(Separated_objects, components_keep_their_numbers_where_a_name_is_taken) {
  Scene scene = two_pairs();
  auto parts = separated_objects(scene.objects[1], Separate::components);
  scene.objects[1] = std::move(parts[0]);
  scene.objects[1].name = "a_1";
  separate(scene, Separate::components);
  EXPECT_EQ(names(scene.objects), (std::vector<std::string>{"a_2_1", "a_2_2", "a_1"}));
}

TEST_F(Separated_objects, parts_are_those_that_the_file_names) {
  // Two parts share a vertex; one goes on later; a face comes before all parts.
  const auto file = folder.write("parts.obj", R"(v 0 0 0
v 1 0 0
v 0 1 0
v 5 0 0
v 5 1 0
v 5 0 1
f 1 2 3
o left
f 1 3 2
g ignored
o right hand
f 4 5 6 2
o nothing
o left
f 1 2 6
)");
  const auto objects = separated_objects(read_object("parts", file), Separate::parts);
  ASSERT_EQ(names(objects), (std::vector<std::string>{"parts", "left", "right hand"}));
  EXPECT_EQ(objects[0].file_face, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(objects[1].file_face, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(objects[2].file_face, (std::vector<std::uint32_t>{2, 2}));
  EXPECT_EQ(objects[1].file_vertices, 4U);
  EXPECT_EQ(CGAL::Polygon_mesh_processing::bbox(objects[2].mesh), CGAL::Bbox_3(1, 0, 0, 5, 1, 1));
}

TEST_F(Separated_objects, groups_are_parts_if_there_are_no_objects) {
  const auto file = folder.write("parts.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a b\nf 1 2 3\ng c\nf 1 3 2\n");
  EXPECT_EQ(names(separated_objects(read_object("x", file), Separate::parts)), (std::vector<std::string>{"a b", "c"}));
  const auto plain = folder.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(names(separated_objects(read_object("x", plain), Separate::parts)), std::vector<std::string>{"x"});
  const auto latin = folder.write("latin.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng f\xfc\nf 1 2 3\ng f\xfd\nf 1 3 2\n");
  EXPECT_EQ(names(separated_objects(read_object("x", latin), Separate::parts)),
            (std::vector<std::string>{"f\uFFFD", "f\uFFFD"}));
}

TEST_F(Separated_objects, names_of_parts_can_hold_what_begins_a_comment_elsewhere) {
  const auto file = folder.write("parts.obj",
                                 "v 0 0 0 # a comment\nv 1 0 0\nv 0 1 0\ng Mesh1  Box#1 Room\nf 1 2 3#another\n"
                                 "g Mesh1 Box#2 Room # not of the name \\\nf 1 3 2\n"
                                 "g \\\nBox#3 \\\nof#it\nf 1 2 3#x\n");
  EXPECT_EQ(names(separated_objects(read_object("x", file), Separate::parts)),
            (std::vector<std::string>{"Mesh1 Box#1 Room", "Mesh1 Box#2 Room", "Box#3 of#it"}));
}

TEST_F(Separated_objects, parts_of_a_sequence_are_those_of_its_first_file) {
  const std::string faces = "o a\nf 1 2 3\no b\nf 4 5 6\n";
  for (const int x : {3, 4, 5})
    folder.write("s_" + std::to_string(x) + ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv " + std::to_string(x) +
                                                        " 0 0\nv 9 0 0\nv 9 1 0\n" +
                                                        (x == 3 ? faces : faces.substr(4)));
  auto objects = separated_objects(read_object("s", folder.path() / "s_#.obj"), Separate::parts);
  ASSERT_EQ(names(objects), (std::vector<std::string>{"a", "b"}));
  pose(objects[1], 2);
  EXPECT_EQ(CGAL::Polygon_mesh_processing::bbox(objects[1].mesh).xmin(), 5);
}

TEST_F(Separated_objects, nodes_of_a_gltf_file_are_parts) {
  // Two nodes of one name, and one without a name, show one mesh.
  auto sample = square_gltf();
  const auto shown = [](const char* name, double z) {
    return nlohmann::json{{"name", name}, {"mesh", 0}, {"translation", {0.0, 0.0, z}}};
  };
  sample.json["nodes"] = {shown("a", 0), shown("a", 7), {{"mesh", 0}}};
  sample.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  sample.json["scene"] = 0;
  const auto file = folder.write("three.gltf", sample.gltf());
  auto objects = separated_objects(read_object("three", file), Separate::parts);
  ASSERT_EQ(names(objects), (std::vector<std::string>{"a", "a_2", "node_2"}));
  pose(objects[1], 0);
  EXPECT_EQ(CGAL::Polygon_mesh_processing::bbox(objects[1].mesh).zmin(), 7);
}

TEST_F(Separated_objects, more_than_a_scene_can_have_are_refused) {
  const auto message = message_of<Bad_scene>([&] { separated_objects(chips("soup", 10'001), Separate::components); });
  EXPECT_TRUE(message.starts_with("soup: 10001 connected components; expected at most 10000")) << message;
}

TEST_F(Separated_objects, more_than_a_scene_can_have_in_all_are_refused) {
  Scene scene;
  scene.name = "many";
  scene.objects.push_back(chips("all", 10'000)), scene.objects.push_back(chips("one", 1));
  EXPECT_EQ(message_of<Bad_scene>([&] { separate(scene, Separate::components); }),
            "many: 10001 objects; expected at most 10000");
  Scene ignoring;
  ignoring.objects.push_back(chips("a", 1001)), ignoring.objects.push_back(chips("b", 1000));
  ignoring.ignored = {{0, 1}};
  EXPECT_EQ(message_of<Bad_scene>([&] { separate(ignoring, Separate::components); }),
            "the parts of objects: 1001000 ignored pairs; expected at most 1000000");
}

}  // namespace
}  // namespace lodestone::test
