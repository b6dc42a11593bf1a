// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "io/temporary_folder.h"
#include "lodestone/errors.h"
#include "lodestone/io/deformation.h"
#include "lodestone/io/shapes.h"

namespace lodestone {
namespace {

using test::Temporary_folder;

/// The corner of the unit cube at the origin, as a closed tetrahedron, moved by `x` along the x-axis.
std::string tetrahedron(int x = 0) {
  const std::string here = std::to_string(x);
  const std::string next = std::to_string(x + 1);
  return "OFF\n4 4 0\n" + here + " 0 0\n" + next + " 0 0\n" + here + " 1 0\n" + here +
         " 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
}

Scene read(const Temporary_folder& folder, std::string_view text) {
  return read_scene(folder.write("scene.json", text));
}

/// What the reader says about a scene, without the folder's name; meshes a.off and frame_1.off to frame_3.off are
/// there.
std::string error_of(std::string_view text) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron());
  for (int i = 1; i <= 3; ++i) folder.write("frame_" + std::to_string(i) + ".off", tetrahedron(i));
  try {
    read(folder, text);
  } catch (const Bad_scene& error) {
    const std::string message = error.what();
    const std::string place = folder.path().string() + "/";
    EXPECT_TRUE(message.starts_with(place)) << message;
    EXPECT_EQ(message.find('\n'), message.npos) << message;
    return message.substr(place.size());
  }
  return "no error";
}

/// A scene of one object with these keys besides its name.
std::string with_object(std::string_view keys) { return R"({"objects": [{"name": "a", )" + std::string(keys) + "}]}"; }

std::string with_deformation(std::string_view deformation) {
  return R"({"frames": 9, "objects": [{"name": "a", "mesh": "a.off", "motion": {"deform": [)" +
         std::string(deformation) + "]}}]}";
}

Point corner(const Scene_object& object, std::size_t i) {
  return object.mesh.point(Surface_mesh::Vertex_index(static_cast<std::uint32_t>(i)));
}

// ---- Good scenes ----

TEST(Read_scene, least_scene_has_one_frame_and_the_files_name) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron());
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

TEST(Read_scene, takes_every_setting) {
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
  folder.write("a.off", tetrahedron());
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
  folder.write("a.off", tetrahedron());
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

TEST(Read_scene, fills_in_the_defaults_of_deformations) {
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

TEST(Read_scene, takes_a_sequence_as_a_list_or_a_pattern_and_its_length_as_the_scenes) {
  for (const std::string sequence :
       {R"(["m/007.off", "m/008.off", "m/009.off"])", R"({"pattern": "m/###.off", "first": 7, "last": 9})"}) {
    const Temporary_folder folder;
    create_directory(folder.path() / "m");
    for (int i = 7; i <= 9; ++i) folder.write("m/00" + std::to_string(i) + ".off", tetrahedron(i));
    Scene scene = read(folder, with_object(R"("mesh": "m/007.off", "motion": {"sequence": )" + sequence + "}"));
    EXPECT_EQ(scene.frames, 3U);
    pose(scene.objects[0], 2);
    EXPECT_EQ(corner(scene.objects[0], 1), Point(10, 0, 0));
    pose(scene.objects[0], 0);
    EXPECT_EQ(corner(scene.objects[0], 1), Point(8, 0, 0));
  }
}

TEST(Read_scene, lasts_as_long_as_the_shortest_motion_that_ends) {
  const Temporary_folder folder;
  for (int i = 1; i <= 3; ++i) folder.write("frame_" + std::to_string(i) + ".off", tetrahedron(i));
  const Scene scene = read(folder, R"({"objects": [
    {"name": "a", "mesh": "frame_1.off", "motion": {"sequence": {"pattern": "frame_#.off", "first": 1, "last": 3}}},
    {"name": "b", "mesh": "frame_1.off", "motion": {"sequence": {"pattern": "frame_#.off", "first": 2, "last": 3}}},
    {"name": "c", "mesh": "frame_1.off", "motion": {"deform": [{"spin": {}}]}},
    {"name": "d", "mesh": "frame_1.off"}]})");
  EXPECT_EQ(scene.frames, 2U);
}

TEST(Read_scene, places_the_positions_of_files_too) {
  const Temporary_folder folder;
  for (int i = 1; i <= 3; ++i) folder.write("frame_" + std::to_string(i) + ".off", tetrahedron(i));
  Scene scene = read(folder, with_object(R"("mesh": "frame_1.off", "place": {"scale": 2, "translate": [0, 1, 0]},
    "motion": {"sequence": {"pattern": "frame_#.off", "first": 1, "last": 3}})"));
  pose(scene.objects[0], 2);
  EXPECT_EQ(corner(scene.objects[0], 1), Point(8, 1, 0));
}

TEST(Read_scene, follows_links_that_stay_inside) {
  const Temporary_folder folder;
  create_directory(folder.path() / "meshes");
  folder.write("meshes/a.off", tetrahedron());
  std::filesystem::create_symlink("meshes/a.off", folder.path() / "link.off");
  EXPECT_EQ(read(folder, with_object(R"("mesh": "link.off")")).objects.size(), 1U);
  EXPECT_EQ(read(folder, with_object(R"("mesh": "meshes/../meshes/a.off")")).objects.size(), 1U);
}

TEST(Read_scene, is_found_from_inside_its_folder) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron());
  folder.write("scene.json", with_object(R"("mesh": "a.off")"));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_NO_THROW(read_scene("scene.json"));
  std::filesystem::current_path(before);
}

TEST(Still_object, never_moves) {
  const Temporary_folder folder;
  Scene_object object = still_object("it", folder.write("a.off", tetrahedron(3)));
  EXPECT_EQ(object.name, "it");
  EXPECT_EQ(object.motion.frames, 0U);
  pose(object, 99);
  EXPECT_EQ(corner(object, 1), Point(4, 0, 0));
}

TEST(Pose, leaves_the_mesh_as_it_was_when_a_coordinate_is_not_finite) {
  const Temporary_folder folder;
  Scene_object object = still_object("it", folder.write("a.off", tetrahedron()));
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

TEST(Pose, writes_each_mesh_vertex_from_its_number_in_the_file) {
  const Temporary_folder folder;
  Scene_object object = still_object("it", folder.write("a.off", tetrahedron()));
  object.file_vertex = {3, 3, 0, 1};
  object.file_vertices = 6;
  object.motion.pose = [](std::size_t, std::span<Point> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = Point(double(i), 0, 0);
  };
  pose(object, 0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(corner(object, i).x(), double(object.file_vertex[i]));
}

// ---- Bad scenes: structure ----

TEST(Bad_scenes, unknown_key_in_a_motion) {
  EXPECT_EQ(
      error_of(
          R"({"objects": [{"name": "a", "mesh": "a.off"}, {"name": "b", "mesh": "a.off", "motion": {"pc": "a"}}]})"),
      R"(scene.json: /objects/1/motion: unknown key "pc" (expected one of pc2, sequence, deform))");
}

TEST(Bad_scenes, unknown_keys_everywhere_else) {
  EXPECT_EQ(error_of(R"({"object": []})"),
            R"(scene.json: /: unknown key "object" (expected one of name, description, frames, objects))");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "colour": 1)")).substr(0, 46),
            R"(scene.json: /objects/0: unknown key "colour" ()");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"shift": 1})")),
            R"(scene.json: /objects/0/place: unknown key "shift" (expected one of scale, rotate, translate))");
  EXPECT_EQ(error_of(with_object(R"("shape": {"icosphere": {"frequency": 1, "n": 2}})")),
            R"(scene.json: /objects/0/shape/icosphere: unknown key "n" (expected one of frequency))");
  EXPECT_EQ(
      error_of(with_deformation(R"({"spin": {"axes": 1}})")),
      R"(scene.json: /objects/0/motion/deform/0/spin: unknown key "axes" (expected one of axis, degrees_per_frame))");
  EXPECT_EQ(
      error_of(with_deformation(R"({"travel": {"way_points": [{"frame": 0, "at": [0, 0, 0], "x": 0}]}})")),
      R"(scene.json: /objects/0/motion/deform/0/travel/way_points/0: unknown key "x" (expected one of frame, at))");
}

TEST(Bad_scenes, an_unknown_key_cannot_break_the_line_of_the_message) {
  EXPECT_EQ(error_of(R"({"a\n\u0000b": 1})"),
            R"(scene.json: /: unknown key "a\n\u0000b" (expected one of name, description, frames, objects))");
  EXPECT_LT(error_of("{\"" + std::string(100'000, 'x') + "\": 1}").size(), 300U);
}

TEST(Bad_scenes, missing_keys) {
  EXPECT_EQ(error_of("{}"), R"(scene.json: /: missing key "objects")");
  EXPECT_EQ(error_of(R"({"objects": [{"mesh": "a.off"}]})"), R"(scene.json: /objects/0: missing key "name")");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a"}]})"), "scene.json: /objects/0: missing key: one of mesh, shape");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {})")),
            "scene.json: /objects/0/motion: missing key: one of pc2, sequence, deform");
  EXPECT_EQ(error_of(with_object(R"("shape": {"uv_sphere": {"slices": 5}})")),
            R"(scene.json: /objects/0/shape/uv_sphere: missing key "stacks")");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"rotate": {"axis": [1, 0, 0]}})")),
            R"(scene.json: /objects/0/place/rotate: missing key "degrees")");
  EXPECT_EQ(error_of(with_deformation(R"({"travel": {}})")),
            R"(scene.json: /objects/0/motion/deform/0/travel: missing key "way_points")");
}

TEST(Bad_scenes, keys_that_exclude_each_other) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "shape": {"teapot": {}})")),
            "scene.json: /objects/0: mesh and shape exclude each other");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"pc2": "a", "deform": []})")),
            "scene.json: /objects/0/motion: pc2 and deform exclude each other");
}

TEST(Bad_scenes, wrong_types) {
  EXPECT_EQ(error_of("[]"), "scene.json: /: expected an object, found array");
  EXPECT_EQ(error_of("3"), "scene.json: /: expected an object, found number");
  EXPECT_EQ(error_of(R"({"objects": {}})"), "scene.json: /objects: expected an array, found object");
  EXPECT_EQ(error_of(R"({"objects": [7]})"), "scene.json: /objects/0: expected an object, found number");
  EXPECT_EQ(error_of(R"({"objects": [{"name": 7, "mesh": "a.off"}]})"),
            "scene.json: /objects/0/name: expected a string, found number");
  EXPECT_EQ(error_of(with_object(R"("mesh": ["a.off"])")),
            "scene.json: /objects/0/mesh: expected a string, found array");
  EXPECT_EQ(error_of(with_object(R"("shape": "teapot")")),
            "scene.json: /objects/0/shape: expected an object, found string");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": null)")),
            "scene.json: /objects/0/place: expected an object, found null");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "particles": "8")")),
            "scene.json: /objects/0/particles: expected a number, found string");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"translate": 1})")),
            "scene.json: /objects/0/place/translate: expected an array of 3 numbers, found number");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"sequence": "a.off"})")),
            "scene.json: /objects/0/motion/sequence: expected an object, found string");
}

TEST(Bad_scenes, wrong_numbers_of_components) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": [1, 2]})")),
            "scene.json: /objects/0/place/scale: expected 3 numbers, found 2");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "scattered_side": [1, 2, 3, 4])")),
            "scene.json: /objects/0/scattered_side: expected 3 numbers, found 4");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "scattered_side": [1, 2, "z"])")),
            "scene.json: /objects/0/scattered_side/2: expected a number, found string");
}

TEST(Bad_scenes, counts_out_of_range) {
  for (const std::string bad : {"0", "-1", "100001", "1.5", "1e30", "18446744073709551617"}) {
    const std::string message = error_of(with_object(R"("mesh": "a.off", "particles": )" + bad));
    EXPECT_TRUE(message.starts_with("scene.json: /objects/0/particles: ")) << message;
    EXPECT_TRUE(message.ends_with(" is not a whole number from 1 to 100000")) << message;
  }
  EXPECT_EQ(error_of(with_object(R"("shape": {"teapot": {"u": 201}})")),
            "scene.json: /objects/0/shape/teapot/u: 201 is not a whole number from 1 to 200");
  EXPECT_EQ(error_of(with_object(R"("shape": {"uv_sphere": {"slices": 2, "stacks": 5}})")),
            "scene.json: /objects/0/shape/uv_sphere/slices: 2 is not a whole number from 3 to 2000");
  EXPECT_EQ(error_of(R"({"frames": 0, "objects": [{"name": "a", "mesh": "a.off"}]})"),
            "scene.json: /frames: 0 is not a whole number from 1 to 1000000");
}

TEST(Bad_scenes, numbers_too_large_for_a_double) {
  EXPECT_EQ(error_of("{\n  \"frames\": 1e999\n}"), "scene.json:2:17: number overflow parsing '1e999'");
}

TEST(Bad_scenes, shapes_and_deformations_out_of_range) {
  EXPECT_EQ(error_of(with_object(R"("shape": {"torus_knot": {"p": 2, "q": 4}})")),
            "scene.json: /objects/0/shape/torus_knot: torus_knot: p = 2 and q = 4 have a common divisor");
  EXPECT_EQ(error_of(with_object(R"("shape": {"torus_knot": {"tube": 0}})")),
            "scene.json: /objects/0/shape/torus_knot: torus_knot: tube is 0, must be positive and finite");
  EXPECT_EQ(error_of(with_deformation(R"({"twist": {}}, {"bend": {"period": -3}})")),
            "scene.json: /objects/0/motion/deform/1/bend: period is -3, must be >= 0 and finite");
  EXPECT_EQ(error_of(with_deformation(
                R"({"travel": {"way_points": [{"frame": 4, "at": [0, 0, 0]}, {"frame": 4, "at": [0, 0, 0]}]}})")),
            "scene.json: /objects/0/motion/deform/0/travel: way point 1 is not after the one before");
  EXPECT_EQ(
      error_of(with_deformation(R"({"travel": {"way_points": [{"frame": 4, "at": [0, 0, 0]}], "path": "curly"}})")),
      R"(scene.json: /objects/0/motion/deform/0/travel/path: "curly" is not one of linear, smooth, closed)");
}

TEST(Bad_scenes, scales_that_turn_the_shape_inside_out_and_directions_without_one) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": 0})")),
            "scene.json: /objects/0/place/scale: 0 is not > 0");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": [1, -1, 1]})")),
            "scene.json: /objects/0/place/scale/1: -1 is not > 0");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "scattered_side": [0, 0, 0])")),
            "scene.json: /objects/0/scattered_side: a direction must not be zero");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"rotate": {"axis": [0, 0, 0], "degrees": 1}})")),
            "scene.json: /objects/0/place/rotate/axis: a direction must not be zero");
}

TEST(Bad_scenes, placement_out_of_the_range_of_numbers) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": 1e308, "translate": [1.5e308, 0, 0]})")),
            "scene.json: /objects/0/place: moves a vertex to a non-finite place");
}

TEST(Bad_scenes, names_that_are_empty_taken_or_unprintable) {
  EXPECT_EQ(error_of(R"({"objects": [{"name": "", "mesh": "a.off"}]})"), "scene.json: /objects/0/name: is empty");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a", "mesh": "a.off"}, {"name": "a", "mesh": "a.off"}]})"),
            R"(scene.json: /objects/1/name: "a" is taken by an object above)");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a\tb", "mesh": "a.off"}]})"),
            R"(scene.json: /objects/0/name: "a\tb" has a control character)");
}

TEST(Bad_scenes, empty_lists) {
  EXPECT_EQ(error_of(R"({"objects": []})"), "scene.json: /objects: is empty");
  EXPECT_EQ(error_of(with_deformation("")), "scene.json: /objects/0/motion/deform: is empty");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"sequence": []})")),
            "scene.json: /objects/0/motion/sequence: is empty");
}

// ---- Bad scenes: frames ----

TEST(Bad_scenes, more_frames_than_a_motion_holds) {
  EXPECT_EQ(error_of(R"({"frames": 4, "objects": [{"name": "a", "mesh": "a.off",
                       "motion": {"sequence": {"pattern": "frame_#.off", "first": 1, "last": 3}}}]})"),
            "scene.json: /frames: 4 frames are more than the 3 of the shortest motion");
}

TEST(Bad_scenes, no_frames_though_no_motion_ends) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"deform": [{"spin": {}}]})")),
            R"(scene.json: /: missing key "frames": no motion ends by itself)");
}

TEST(Bad_scenes, patterns_that_name_no_sequence) {
  const auto with_pattern = [](const std::string& pattern, const std::string& last) {
    return with_object(R"("mesh": "a.off", "motion": {"sequence": {"pattern": ")" + pattern +
                       R"(", "first": 2, "last": )" + last + "}}");
  };
  EXPECT_EQ(
      error_of(with_pattern("frame.off", "3")),
      R"(scene.json: /objects/0/motion/sequence/pattern: "frame.off" must have one run of # in the number's place)");
  EXPECT_EQ(
      error_of(with_pattern("#_#.off", "3")),
      R"(scene.json: /objects/0/motion/sequence/pattern: "#_#.off" must have one run of # in the number's place)");
  EXPECT_EQ(error_of(with_pattern("frame_#.off", "1")),
            "scene.json: /objects/0/motion/sequence/last: 1 is not a whole number from 2 to 1000000");
}

// ---- Bad scenes: files ----

TEST(Bad_scenes, paths_that_leave_the_folder) {
  for (const std::string bad : {"../a.off", "x/../../a.off", "/etc/passwd", "..", "."})
    EXPECT_EQ(error_of(with_object(R"("mesh": ")" + bad + R"(")")),
              R"(scene.json: /objects/0/mesh: ")" + bad + R"(" is not inside the scene's folder)");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"pc2": "../a.pc2"})")),
            R"(scene.json: /objects/0/motion/pc2: "../a.pc2" is not inside the scene's folder)");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"sequence": ["a.off", "../b.off"]})")),
            R"(scene.json: /objects/0/motion/sequence/1: "../b.off" is not inside the scene's folder)");
  EXPECT_EQ(error_of(with_object(
                R"("mesh": "a.off", "motion": {"sequence": {"pattern": "../#.off", "first": 1, "last": 1}})")),
            R"(scene.json: /objects/0/motion/sequence/pattern: "../1.off" is not inside the scene's folder)");
}

TEST(Bad_scenes, absolute_path_to_a_file_inside_the_folder) {
  const Temporary_folder folder;
  const auto mesh = folder.write("a.off", tetrahedron());
  EXPECT_THROW(read(folder, with_object(R"("mesh": ")" + mesh.string() + R"(")")), Bad_scene);
}

TEST(Bad_scenes, neighbour_whose_name_starts_like_the_folders) {
  const Temporary_folder folder;
  for (const auto* name : {"scenes", "scenes_secret"}) create_directory(folder.path() / name);
  folder.write("scenes_secret/a.off", tetrahedron());
  const auto scene = folder.write("scenes/scene.json", with_object(R"("mesh": "../scenes_secret/a.off")"));
  EXPECT_THROW(read_scene(scene), Bad_scene);
}

TEST(Bad_scenes, links_that_lead_outside) {
  const Temporary_folder outside;
  outside.write("a.off", tetrahedron());
  const Temporary_folder folder;
  std::filesystem::create_symlink(outside.path() / "a.off", folder.path() / "file.off");
  std::filesystem::create_directory_symlink(outside.path(), folder.path() / "folder");
  EXPECT_THROW(read(folder, with_object(R"("mesh": "file.off")")), Bad_scene);
  EXPECT_THROW(read(folder, with_object(R"("mesh": "folder/a.off")")), Bad_scene);
}

TEST(Bad_scenes, links_in_a_circle) {
  const Temporary_folder folder;
  std::filesystem::create_symlink("loop.off", folder.path() / "loop.off");
  EXPECT_THROW(read(folder, with_object(R"("mesh": "loop.off")")), Bad_scene);
}

TEST(Bad_scenes, file_names_with_a_hidden_end) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off\u0000.txt")")),
            R"(scene.json: /objects/0/mesh: "a.off\u0000.txt" has a control character)");
}

TEST(Bad_scenes, missing_and_broken_meshes_keep_their_own_error) {
  const Temporary_folder folder;
  folder.write("broken.off", "OFF\n4 4 0\n0 0 0\n");
  for (const std::string name : {"missing.off", "broken.off"}) {
    try {
      read(folder, with_object(R"("mesh": ")" + name + R"(")"));
      FAIL() << "accepted";
    } catch (const Bad_mesh& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

// ---- Bad scenes: JSON ----

TEST(Bad_scenes, syntax_errors_have_line_and_column) {
  EXPECT_EQ(error_of("{\n  \"objects\": [,]\n}").substr(0, 17), "scene.json:2:15: ");
  EXPECT_EQ(error_of("{\"a\" 1}").substr(0, 16), "scene.json:1:6: ");
  EXPECT_EQ(error_of("").substr(0, 16), "scene.json:1:1: ");
  EXPECT_EQ(error_of("{\"objects\": [{\"name\": \"a\"}]} x").substr(0, 17), "scene.json:1:30: ");
}

TEST(Bad_scenes, what_json_has_not) {
  for (const std::string bad : {"NaN", "Infinity", "// x", "\"\xff\"", "{'a': 1}", "01"}) {
    const std::string message = error_of(bad);
    EXPECT_TRUE(message.starts_with("scene.json:1:")) << message;
  }
}

TEST(Bad_scenes, keys_that_stand_twice) {
  EXPECT_EQ(error_of(R"({"objects": [], "objects": []})"), R"(scene.json: /: key "objects" stands twice)");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a"}, {"name": "b", "mesh": "a.off", "name": "c"}]})"),
            R"(scene.json: /objects/1: key "name" stands twice)");
  EXPECT_EQ(error_of(R"({"x": [[1, {}], 2, {"y": {"z": 1, "z": 1}}]})"), R"(scene.json: /x/2/y: key "z" stands twice)");
}

TEST(Bad_scenes, bottomless_nesting) {
  for (const std::string open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += open;
    EXPECT_NE(error_of(text).find("is nested deeper than 32 levels"), std::string::npos);
  }
  EXPECT_NE(error_of(std::string(100'000, '[') + std::string(100'000, ']')).find("is nested deeper than 32 levels"),
            std::string::npos);
}

TEST(Bad_scenes, scene_files_that_are_none) {
  const Temporary_folder folder;
  const auto message_of = [](const std::filesystem::path& file) {
    try {
      read_scene(file);
    } catch (const Bad_scene& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message_of(folder.path() / "none.json"), (folder.path() / "none.json").string() + ": no such file");
  EXPECT_EQ(message_of(folder.path()), folder.path().string() + ": is not a regular file");
  EXPECT_EQ(message_of("/dev/zero"), "/dev/zero: is not a regular file");
  const auto huge = folder.write("huge.json", "");
  std::filesystem::resize_file(huge, std::uintmax_t{1} << 40U);
  EXPECT_EQ(message_of(huge), huge.string() + ": is longer than 16 MiB, too long for a scene");
}

}  // namespace
}  // namespace lodestone
