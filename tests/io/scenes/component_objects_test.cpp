// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/component_objects.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/boost/graph/helpers.h>
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
#include "support/message_of.h"
#include "support/moving_mesh_files.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Component_objects : public testing::Test {
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
  static std::vector<std::string> names(const std::vector<Scene_object>& objects) {
    std::vector<std::string> names;
    for (const auto& object : objects) names.push_back(object.name);
    return names;
  }

  Temporary_folder folder;
};

TEST_F(Component_objects, are_in_the_order_of_their_first_faces_and_move_as_their_part_of_the_whole_does) {
  auto objects = component_objects(pair());
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

TEST_F(Component_objects, pose_the_whole_once_per_frame) {
  Scene_object whole = pair();
  const auto poses = std::make_shared<int>(0);
  whole.motion.pose = [poses, inner = whole.motion.pose](std::size_t frame, std::span<Point> positions) {
    ++*poses;
    inner(frame, positions);
  };
  auto objects = component_objects(whole);
  for (std::size_t frame = 0; frame < 3; ++frame)
    for (auto& object : objects) pose(object, frame);
  EXPECT_EQ(*poses, 3);
}

TEST_F(Component_objects, a_frame_that_cannot_be_read_is_tried_again_by_each) {
  Scene_object whole = pair();
  const auto is_broken = std::make_shared<bool>(true);
  whole.motion.pose = [is_broken, inner = whole.motion.pose](std::size_t frame, std::span<Point> positions) {
    inner(frame, positions);
    if (*is_broken) throw Bad_motion("broken");
  };
  auto objects = component_objects(whole);
  for (auto& object : objects) EXPECT_THROW(pose(object, 1), Bad_motion);
  *is_broken = false;
  for (auto& object : objects) pose(object, 1);
  EXPECT_EQ(CGAL::Polygon_mesh_processing::bbox(objects[0].mesh).xmin(), 1.5);
}

TEST_F(Component_objects, compute_the_positions_that_they_are_posed_to) {
  std::ofstream(folder.path() / "scene.json") << R"({"frames": 4, "objects": [{"name": "both", "mesh": "pair.off",
    "motion": {"deform": [{"twist": {"axis": [1, 2, 3], "degrees": 90, "period": 4}}]}}]})";
  write_two_tetrahedra_in_one_mesh(folder.path() / "pair", 1);
  Scene scene = read_scene(folder.path() / "scene.json");
  separate_components(scene);
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

TEST_F(Component_objects, take_the_place_of_the_whole_with_its_groups_and_the_pairs_that_it_ignores) {
  Scene scene = two_pairs();
  scene.objects[0].collision = {.groups = 2, .meets = 3};
  scene.ignored = {{0, 0}, {0, 1}};
  separate_components(scene);
  ASSERT_EQ(names(scene.objects), (std::vector<std::string>{"a_1", "a_2", "b_1", "b_2"}));
  EXPECT_EQ(scene.objects[1].collision.groups, 2U);
  EXPECT_EQ(scene.objects[1].collision.meets, 3U);
  const std::vector<Object_pair> ignored{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 1}, {1, 2}, {1, 3}};
  EXPECT_EQ(scene.ignored, ignored);
}

TEST_F(Component_objects, an_object_of_one_component_stays_as_it_is) {
  Scene scene = two_pairs();
  auto parts = component_objects(scene.objects[1]);
  scene.objects[1] = std::move(parts[1]);
  scene.ignored = {{0, 1}};
  separate_components(scene);
  EXPECT_EQ(names(scene.objects), (std::vector<std::string>{"a_1", "a_2", "b_2"}));
  EXPECT_EQ(scene.ignored, (std::vector<Object_pair>{{0, 2}, {1, 2}}));
}

TEST_F(Component_objects, a_name_that_is_taken_gets_a_number) {
  Scene scene = two_pairs();
  scene.objects[1].name = "a_2";
  separate_components(scene);
  EXPECT_EQ(names(scene.objects), (std::vector<std::string>{"a_1", "a_2_2", "a_2_1", "a_2_2_2"}));
}

TEST_F(Component_objects, more_than_a_scene_can_have_are_refused) {
  std::ofstream file(folder.path() / "soup.off");
  file << "OFF\n30003 10001 0\n";
  for (int face = 0; face <= 10'000; ++face) file << face << " 0 0\n" << face << " 1 0\n" << face << " 0 1\n";
  for (int face = 0; face <= 10'000; ++face)
    file << "3 " << 3 * face << ' ' << 3 * face + 1 << ' ' << 3 * face + 2 << '\n';
  file.close();
  const auto soup = read_object("soup", folder.path() / "soup.off");
  const auto message = message_of<Bad_scene>([&] { component_objects(soup); });
  EXPECT_TRUE(message.starts_with("soup: 10001 connected components; expected at most 10000")) << message;
}

}  // namespace
}  // namespace lodestone::test
