// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/scene_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/errors.h"
#include "support/gltf_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

using test::read;
using test::Temporary_folder;
using test::tetrahedron_off;
using test::with_object;

Point corner(const Scene_object& object, std::size_t i) {
  return object.mesh.point(Surface_mesh::Vertex_index(static_cast<std::uint32_t>(i)));
}

TEST(Read_scene, a_minimal_scene_has_one_frame_and_the_file_s_name) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron_off());
  Scene scene = read(folder, with_object(R"("mesh": "a.off")"));
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.description, "");
  EXPECT_EQ(scene.frames, 1U);
  ASSERT_EQ(scene.objects.size(), 1U);
  Scene_object& object = scene.objects[0];
  EXPECT_EQ(object.name, "a");
  EXPECT_EQ(object.mesh.number_of_faces(), 4U);
  EXPECT_EQ(object.file_vertices, 4U);
  EXPECT_EQ(object.particles, 0U);
  EXPECT_FALSE(object.scattered_side);
  pose(object, 17);
  EXPECT_EQ(corner(object, 1), Point(1, 0, 0));
}

TEST(Read_scene, objects_list_each_file_that_they_are_read_from_once) {
  const Temporary_folder folder;
  const auto sample = test::square_with_two_animations();
  folder.write("a.gltf", sample.gltf("a.bin"));
  folder.write("b.gltf", sample.gltf("b.bin"));
  folder.write("a.bin", sample.bytes), folder.write("b.bin", sample.bytes);
  const auto files_of = [&](const std::string& object) {
    const Scene scene = read(folder, with_object(object));
    std::vector<std::string> names;
    for (const auto& file : scene.objects[0].files) names.push_back(file.filename().string());
    return names;
  };
  EXPECT_EQ(files_of(R"("mesh": "a.gltf", "motion": {"gltf": "a.gltf"})"),
            (std::vector<std::string>{"a.gltf", "a.bin"}));
  EXPECT_EQ(files_of(R"("mesh": "a.gltf", "motion": {"gltf": "b.gltf"})"),
            (std::vector<std::string>{"a.gltf", "b.gltf", "a.bin", "b.bin"}));
}

TEST(Read_scene, reads_every_setting) {
  const Temporary_folder folder;
  const Scene scene = read(folder, R"({"name": "two", "description": "why", "frames": 7, "objects": [
    {"name": "a", "shape": {"icosphere": {"frequency": 2}}, "particles": 12, "scattered_side": [0, 0, -2]},
    {"name": "b", "shape": {"cloth": {"columns": 2, "rows": 3}}}]})");
  EXPECT_EQ(scene.name, "two");
  EXPECT_EQ(scene.description, "why");
  EXPECT_EQ(scene.frames, 7U);
  EXPECT_EQ(scene.objects[0].particles, 12U);
  EXPECT_EQ(scene.objects[0].scattered_side, Kernel::Vector_3(0, 0, -2));
  EXPECT_EQ(scene.objects[1].mesh.number_of_faces(), 12U);
}

TEST(Read_scene, makes_every_shape) {
  const Temporary_folder folder;
  const Scene scene = read(folder, R"({"objects": [
    {"name": "1", "shape": {"teapot": {"u": 3, "v": 4}}},
    {"name": "2", "shape": {"uv_sphere": {"slices": 30, "stacks": 22}}},
    {"name": "3", "shape": {"icosphere": {"frequency": 4}}},
    {"name": "4", "shape": {"torus_knot": {"p": 3, "q": 2, "radius": 2, "tube": 0.1, "segments": 50, "sides": 5}}},
    {"name": "5", "shape": {"cloth": {"columns": 6, "rows": 7}}},
    {"name": "6", "shape": {"teapot": {}}}]})");
  const std::vector<std::size_t> faces{64 * 12 - 32, 1260, 320, 500, 84, teapot().number_of_faces()};
  ASSERT_EQ(scene.objects.size(), faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Scene_object& object = scene.objects[i];
    EXPECT_EQ(object.mesh.number_of_faces(), faces[i]) << object.name;
    EXPECT_EQ(object.file_vertices, object.mesh.number_of_vertices());
    for (const auto v : object.mesh.vertices()) EXPECT_EQ(object.file_vertex[v], std::size_t(v));
  }
}

TEST(Read_scene, scales_then_rotates_then_translates) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron_off());
  Scene scene = read(folder, with_object(R"("mesh": "a.off", "place": {"translate": [5, 0, 0],
    "rotate": {"axis": [0, 0, 9], "degrees": 90}, "scale": [2, 3, 4]})"));
  Scene_object& object = scene.objects[0];
  for (int time = 0; time < 2; ++time) {
    EXPECT_LT(CGAL::squared_distance(corner(object, 0), Point(5, 0, 0)), 1e-24);
    EXPECT_LT(CGAL::squared_distance(corner(object, 1), Point(5, 2, 0)), 1e-24);
    EXPECT_LT(CGAL::squared_distance(corner(object, 2), Point(2, 0, 0)), 1e-24);
    EXPECT_LT(CGAL::squared_distance(corner(object, 3), Point(5, 0, 4)), 1e-24);
    pose(object, 0);
  }
}

TEST(Read_scene, rotates_counter_clockwise_about_any_axis) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron_off());
  const Scene scene =
      read(folder, with_object(R"("mesh": "a.off", "place": {"rotate": {"axis": [1, 1, 1], "degrees": 120}})"));
  // A third of a turn about the diagonal sends x to y, y to z and z to x.
  EXPECT_LT(CGAL::squared_distance(corner(scene.objects[0], 1), Point(0, 1, 0)), 1e-24);
  EXPECT_LT(CGAL::squared_distance(corner(scene.objects[0], 2), Point(0, 0, 1)), 1e-24);
  EXPECT_LT(CGAL::squared_distance(corner(scene.objects[0], 3), Point(1, 0, 0)), 1e-24);
}

TEST(Read_scene, deforms_the_placed_shape_as_the_functions_do) {
  const Temporary_folder folder;
  Scene scene = read(folder, R"({"frames": 50, "objects": [{"name": "a", "shape": {"icosphere": {"frequency": 1}},
    "place": {"scale": 3}, "motion": {"deform": [
      {"wobble": {"amplitude": 0.1, "waves": 2, "period": 30, "phase": 0.25}},
      {"bend": {"axis": [0, 1, 0], "towards": [1, 0, 0], "degrees": 50, "period": 20, "phase": 0.1}},
      {"twist": {"axis": [1, 0, 0], "degrees": 60, "period": 25, "phase": 0.2}},
      {"inflate": {"factor": 4, "frames": 33}},
      {"travel": {"way_points": [{"frame": 1, "at": [0, 0, 0]}, {"frame": 40, "at": [1, 2, 3]}], "path": "linear"}},
      {"spin": {"axis": [0, 1, 0], "degrees_per_frame": 2}}]}}]})");
  Scene_object& object = scene.objects[0];
  std::vector<Point> rest;
  for (const auto v : object.mesh.vertices()) rest.push_back(object.mesh.point(v));
  EXPECT_NEAR(rest[0].z(), 3, 1e-12);
  const Motion expected =
      deform(rest, {Wobble{.amplitude = 0.1, .waves = 2, .period = 30, .phase = 0.25},
                    Bend{{0, 1, 0}, {1, 0, 0}, 50, 20, 0.1}, Twist{{1, 0, 0}, 60, 25, 0.2}, Inflate{4, 33},
                    Travel{{{1, {0, 0, 0}}, {40, {1, 2, 3}}}, Path::linear}, Spin{{0, 1, 0}, 2}});
  std::vector<Point> positions(rest.size());
  expected.pose(13, positions);
  pose(object, 13);
  for (const auto v : object.mesh.vertices()) EXPECT_EQ(object.mesh.point(v), positions[v]);
}

TEST(Read_scene, uses_the_defaults_of_deformations) {
  const Temporary_folder folder;
  Scene scene = read(folder, R"({"frames": 50, "objects": [{"name": "a", "shape": {"icosphere": {"frequency": 2}},
    "motion": {"deform": [{"wobble": {}}, {"bend": {}}, {"twist": {}}, {"inflate": {}}, {"spin": {}},
                          {"travel": {"way_points": [{"frame": 0, "at": [1, 0, 0]}]}}]}}]})");
  Scene_object& object = scene.objects[0];
  std::vector<Point> rest;
  for (const auto v : object.mesh.vertices()) rest.push_back(object.mesh.point(v));
  std::vector<Point> positions(rest.size());
  deform(rest, {Wobble{}, Bend{}, Twist{}, Inflate{}, Spin{}, Travel{{{0, {1, 0, 0}}}}}).pose(7, positions);
  pose(object, 7);
  for (const auto v : object.mesh.vertices()) EXPECT_EQ(object.mesh.point(v), positions[v]);
}

TEST(Read_scene, accepts_a_sequence_as_a_list_or_a_pattern_and_gets_its_length) {
  for (const std::string sequence :
       {R"(["m/007.off", "m/008.off", "m/009.off"])", R"({"pattern": "m/###.off", "first": 7, "last": 9})"}) {
    const Temporary_folder folder;
    create_directory(folder.path() / "m");
    for (int i = 7; i <= 9; ++i) folder.write("m/00" + std::to_string(i) + ".off", tetrahedron_off(i));
    Scene scene = read(folder, with_object(R"("mesh": "m/007.off", "motion": {"sequence": )" + sequence + "}"));
    EXPECT_EQ(scene.frames, 3U);
    pose(scene.objects[0], 2);
    EXPECT_EQ(corner(scene.objects[0], 1), Point(10, 0, 0));
    pose(scene.objects[0], 0);
    EXPECT_EQ(corner(scene.objects[0], 1), Point(8, 0, 0));
  }
}

TEST(Read_scene, takes_the_file_that_a_pattern_names) {
  const Temporary_folder folder;
  folder.write("a#.off", tetrahedron_off(1)), folder.write("a2.off", tetrahedron_off(2));
  folder.write("a3.off", tetrahedron_off(3));
  EXPECT_EQ(read(folder, with_object(R"("mesh": "a2.off", "motion": {"sequence": "a#.off"})")).frames, 1U);
  EXPECT_EQ(read(folder, with_object(R"("mesh": "a2.off", "motion": {"sequence": "a*.off"})")).frames, 2U);
  EXPECT_THROW(read(folder, with_object(R"("mesh": "a2.off", "motion": {"sequence": "a2.off"})")), Bad_scene);
}

TEST(Read_scene, lasts_as_long_as_the_shortest_motion_that_ends) {
  const Temporary_folder folder;
  for (int i = 1; i <= 3; ++i) folder.write("frame_" + std::to_string(i) + ".off", tetrahedron_off(i));
  const Scene scene = read(folder, R"({"objects": [
    {"name": "a", "mesh": "frame_1.off", "motion": {"sequence": {"pattern": "frame_#.off", "first": 1, "last": 3}}},
    {"name": "b", "mesh": "frame_1.off", "motion": {"sequence": {"pattern": "frame_#.off", "first": 2, "last": 3}}},
    {"name": "c", "mesh": "frame_1.off", "motion": {"deform": [{"spin": {}}]}},
    {"name": "d", "mesh": "frame_1.off"}]})");
  EXPECT_EQ(scene.frames, 2U);
}

TEST(Read_scene, places_the_positions_of_files) {
  const Temporary_folder folder;
  for (int i = 1; i <= 3; ++i) folder.write("frame_" + std::to_string(i) + ".off", tetrahedron_off(i));
  Scene scene = read(folder, with_object(R"("mesh": "frame_1.off", "place": {"scale": 2, "translate": [0, 1, 0]},
    "motion": {"sequence": {"pattern": "frame_#.off", "first": 1, "last": 3}})"));
  pose(scene.objects[0], 2);
  EXPECT_EQ(corner(scene.objects[0], 1), Point(8, 1, 0));
}

TEST(Read_scene, follows_links_that_stay_inside) {
  const Temporary_folder folder;
  create_directory(folder.path() / "meshes");
  folder.write("meshes/a.off", tetrahedron_off());
  std::filesystem::create_symlink("meshes/a.off", folder.path() / "link.off");
  EXPECT_EQ(read(folder, with_object(R"("mesh": "link.off")")).objects.size(), 1U);
  EXPECT_EQ(read(folder, with_object(R"("mesh": "meshes/../meshes/a.off")")).objects.size(), 1U);
}

TEST(Read_scene, is_found_from_inside_its_folder) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron_off());
  folder.write("scene.json", with_object(R"("mesh": "a.off")"));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_NO_THROW(read_scene("scene.json"));
  std::filesystem::current_path(before);
}

TEST(Read_object, of_a_mesh_never_moves) {
  const Temporary_folder folder;
  Scene_object object = read_object("it", folder.write("a.off", tetrahedron_off(3)));
  EXPECT_EQ(object.name, "it");
  EXPECT_EQ(object.motion.frames, 1U);
  pose(object, 99);
  EXPECT_EQ(corner(object, 1), Point(4, 0, 0));
}

TEST(Pose, leaves_the_mesh_unchanged_if_a_coordinate_is_not_finite) {
  const Temporary_folder folder;
  Scene_object object = read_object("it", folder.write("a.off", tetrahedron_off()));
  object.motion.pose = [](std::size_t, std::span<Point> positions) {
    for (Point& p : positions) p = Point(7, 7, 7);
    positions[2] = Point(0, std::numeric_limits<double>::quiet_NaN(), 0);
  };
  try {
    pose(object, 5);
    FAIL() << "accepted";
  } catch (const Bad_motion& error) {
    EXPECT_STREQ(error.what(), "it: frame 5: vertex 2 has a non-finite coordinate");
  }
  EXPECT_EQ(corner(object, 1), Point(1, 0, 0));
}

TEST(Pose, moves_each_mesh_vertex_to_the_position_of_its_file_vertex) {
  const Temporary_folder folder;
  Scene_object object = read_object("it", folder.write("a.off", tetrahedron_off()));
  object.file_vertex = {3, 3, 0, 1};
  object.file_vertices = 6;
  object.motion.pose = [](std::size_t, std::span<Point> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = Point(double(i), 0, 0);
  };
  pose(object, 0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(corner(object, i).x(), double(object.file_vertex[i]));
}

}  // namespace
}  // namespace lodestone
