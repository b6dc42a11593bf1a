// SPDX-License-Identifier: GPL-3.0-or-later
// Invalid scenes: one error each, on one line, with file, JSON pointer and cause.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/mesh/errors.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

using test::read;
using test::Temporary_folder;
using test::tetrahedron_off;
using test::with_object;

/// What the reader says about a scene, without the folder's name; meshes a.off and frame_1.off to frame_3.off are
/// there.
std::string error_of(std::string_view text) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron_off());
  for (int i = 1; i <= 3; ++i) folder.write("frame_" + std::to_string(i) + ".off", tetrahedron_off(i));
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

std::string with_deformation(std::string_view deformation) {
  return R"({"frames": 9, "objects": [{"name": "a", "mesh": "a.off", "motion": {"deform": [)" +
         std::string(deformation) + "]}}]}";
}

// ---- Structure ----

TEST(Bad_scene_file, an_unknown_key_in_a_motion_is_refused) {
  EXPECT_EQ(
      error_of(
          R"({"objects": [{"name": "a", "mesh": "a.off"}, {"name": "b", "mesh": "a.off", "motion": {"pc": "a"}}]})"),
      R"(scene.json: /objects/1/motion: unknown key "pc" (expected one of pc2, mdd, gltf, keyframes, sequence, deform))");
}

TEST(Bad_scene_file, unknown_keys_are_refused_everywhere) {
  EXPECT_EQ(
      error_of(R"({"object": []})"),
      R"(scene.json: /: unknown key "object" (expected one of name, description, frames, objects, ignore, $schema))");
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

TEST(Bad_scene_file, an_unknown_key_cannot_break_the_line_of_the_message) {
  EXPECT_EQ(
      error_of(R"({"a\n\u0000b": 1})"),
      R"(scene.json: /: unknown key "a\n\u0000b" (expected one of name, description, frames, objects, ignore, $schema))");
  EXPECT_LT(error_of("{\"" + std::string(100'000, 'x') + "\": 1}").size(), 300U);
}

TEST(Bad_scene_file, missing_keys_are_named) {
  EXPECT_EQ(error_of("{}"), R"(scene.json: /: missing key "objects")");
  EXPECT_EQ(error_of(R"({"objects": [{"mesh": "a.off"}]})"), R"(scene.json: /objects/0: missing key "name")");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a"}]})"), "scene.json: /objects/0: missing key: one of mesh, shape");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {})")),
            "scene.json: /objects/0/motion: missing key: one of pc2, mdd, gltf, keyframes, sequence, deform");
  EXPECT_EQ(error_of(with_object(R"("shape": {"uv_sphere": {"slices": 5}})")),
            R"(scene.json: /objects/0/shape/uv_sphere: missing key "stacks")");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"rotate": {"axis": [1, 0, 0]}})")),
            R"(scene.json: /objects/0/place/rotate: missing key "degrees")");
  EXPECT_EQ(error_of(with_deformation(R"({"travel": {}})")),
            R"(scene.json: /objects/0/motion/deform/0/travel: missing key "way_points")");
}

TEST(Bad_scene_file, mutually_exclusive_keys_are_refused) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "shape": {"teapot": {}})")),
            "scene.json: /objects/0: mesh and shape exclude each other");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"pc2": "a", "deform": []})")),
            "scene.json: /objects/0/motion: pc2 and deform exclude each other");
}

TEST(Bad_scene_file, wrong_types_are_refused) {
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
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"sequence": 7})")),
            "scene.json: /objects/0/motion/sequence: expected an object, found number");
}

TEST(Bad_scene_file, wrong_numbers_of_components_are_refused) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": [1, 2]})")),
            "scene.json: /objects/0/place/scale: expected 3 numbers, found 2");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "scattered_side": [1, 2, 3, 4])")),
            "scene.json: /objects/0/scattered_side: expected 3 numbers, found 4");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "scattered_side": [1, 2, "z"])")),
            "scene.json: /objects/0/scattered_side/2: expected a number, found string");
}

TEST(Bad_scene_file, counts_out_of_range_are_refused) {
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

TEST(Bad_scene_file, numbers_too_large_for_a_double_are_refused) {
  EXPECT_EQ(error_of("{\n  \"frames\": 1e999\n}"), "scene.json:2:17: number overflow parsing '1e999'");
}

TEST(Bad_scene_file, shapes_and_deformations_out_of_range_are_refused) {
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

TEST(Bad_scene_file, negative_scales_and_zero_directions_are_refused) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": 0})")),
            "scene.json: /objects/0/place/scale: 0 is not > 0");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": [1, -1, 1]})")),
            "scene.json: /objects/0/place/scale/1: -1 is not > 0");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "scattered_side": [0, 0, 0])")),
            "scene.json: /objects/0/scattered_side: a direction must not be zero");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"rotate": {"axis": [0, 0, 0], "degrees": 1}})")),
            "scene.json: /objects/0/place/rotate/axis: a direction must not be zero");
}

TEST(Bad_scene_file, a_placement_that_overflows_is_refused) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "place": {"scale": 1e308, "translate": [1.5e308, 0, 0]})")),
            "scene.json: /objects/0/place: moves a vertex to a non-finite position");
}

TEST(Bad_scene_file, empty_duplicate_and_unprintable_names_are_refused) {
  EXPECT_EQ(error_of(R"({"objects": [{"name": "", "mesh": "a.off"}]})"), "scene.json: /objects/0/name: is empty");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a", "mesh": "a.off"}, {"name": "a", "mesh": "a.off"}]})"),
            R"(scene.json: /objects/1/name: "a" is taken by an object above)");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a\tb", "mesh": "a.off"}]})"),
            R"(scene.json: /objects/0/name: "a\tb" has a control character)");
}

TEST(Bad_scene_file, empty_lists_are_refused) {
  EXPECT_EQ(error_of(R"({"objects": []})"), "scene.json: /objects: is empty");
  EXPECT_EQ(error_of(with_deformation("")), "scene.json: /objects/0/motion/deform: is empty");
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"sequence": []})")),
            "scene.json: /objects/0/motion/sequence: is empty");
}

// ---- Frames ----

TEST(Bad_scene_file, more_frames_than_a_motion_has_are_refused) {
  EXPECT_EQ(error_of(R"({"frames": 4, "objects": [{"name": "a", "mesh": "a.off",
                       "motion": {"sequence": {"pattern": "frame_#.off", "first": 1, "last": 3}}}]})"),
            "scene.json: /frames: 4 frames are more than the 3 of the shortest motion");
}

// To look for a million files takes a minute.
TEST(Bad_scene_file, a_sequence_is_refused_at_its_first_missing_file) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron_off());
  try {
    read(folder,
         with_object(R"("mesh": "a.off", "motion": {"sequence": {"pattern": "a#.off", "first": 7, "last": 1000000}})"));
    ADD_FAILURE() << "expected an error";
  } catch (const Bad_motion& error) {
    EXPECT_EQ(error.what(), (folder.path() / "scene.json").string() + ": /objects/0/motion/sequence: " +
                                (folder.path() / "a7.off").string() + ": there is no such file");
  }
}

TEST(Bad_scene_file, an_error_of_a_file_has_its_own_type_and_the_place_in_the_scene) {
  const Temporary_folder folder;
  folder.write("a.off", tetrahedron_off());
  folder.write("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  const auto expect_message = [&](const Error& error, const std::string& place, const std::string& file) {
    const std::string scene = (folder.path() / "scene.json").string() + ": /objects/0/";
    EXPECT_TRUE(std::string(error.what()).starts_with(scene + place + ": " + (folder.path() / file).string() + ":"))
        << error.what();
  };
  for (const std::string file : {"none.off", "b.off"}) try {
      read(folder, with_object(R"("mesh": ")" + file + R"(")"));
      ADD_FAILURE() << "expected an error about " << file;
    } catch (const Bad_mesh& error) {
      expect_message(error, "mesh", file);
    }
  const std::vector<std::pair<std::string, std::string>> motions{{"pc2", "none.pc2"},
                                                                 {"mdd", "none.mdd"},
                                                                 {"gltf", "none.glb"},
                                                                 {"keyframes", "none.md2"},
                                                                 {"sequence", "n*.off"}};
  for (const auto& [kind, file] : motions) try {
      read(folder, with_object(R"("mesh": "a.off", "motion": {")" + kind + R"(": ")" + file + R"("})"));
      ADD_FAILURE() << "expected an error about " << file;
    } catch (const Bad_motion& error) {
      expect_message(error, "motion/" + kind, file);
    }
}

TEST(Bad_scene_file, a_missing_number_of_frames_is_refused_if_no_motion_ends) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"deform": [{"spin": {}}]})")),
            R"(scene.json: /: missing key "frames": no motion ends by itself)");
}

TEST(Bad_scene_file, patterns_that_name_no_sequence_are_refused) {
  const auto with_pattern = [](const std::string& pattern, const std::string& last) {
    return with_object(R"("mesh": "a.off", "motion": {"sequence": {"pattern": ")" + pattern +
                       R"(", "first": 2, "last": )" + last + "}}");
  };
  EXPECT_EQ(error_of(with_pattern("frame.off", "3")),
            R"(scene.json: /objects/0/motion/sequence/pattern: "frame.off" must have one run of # for the number)");
  EXPECT_EQ(error_of(with_pattern("#_#.off", "3")),
            R"(scene.json: /objects/0/motion/sequence/pattern: "#_#.off" must have one run of # for the number)");
  EXPECT_EQ(error_of(with_pattern("frame_#.off", "1")),
            "scene.json: /objects/0/motion/sequence/last: 1 is not a whole number from 2 to 1000000");
}

// ---- Files ----

TEST(Bad_scene_file, paths_that_leave_the_folder_are_refused) {
  const std::string outside =
      R"(" is not inside the scene's folder; the option `allow_outside`, or --allow-outside, allows that)";
  for (const std::string bad : {"../a.off", "x/../../a.off", "/etc/passwd", "..", "."})
    EXPECT_EQ(error_of(with_object(R"("mesh": ")" + bad + R"(")")),
              R"(scene.json: /objects/0/mesh: ")" + bad + outside);
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"pc2": "../a.pc2"})")),
            R"(scene.json: /objects/0/motion/pc2: "../a.pc2)" + outside);
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off", "motion": {"sequence": ["a.off", "../b.off"]})")),
            R"(scene.json: /objects/0/motion/sequence/1: "../b.off)" + outside);
  EXPECT_EQ(error_of(with_object(
                R"("mesh": "a.off", "motion": {"sequence": {"pattern": "../#.off", "first": 1, "last": 1}})")),
            R"(scene.json: /objects/0/motion/sequence/pattern: "../1.off)" + outside);
}

TEST(Bad_scene_file, an_absolute_path_is_refused_even_to_a_file_inside_the_folder) {
  const Temporary_folder folder;
  const auto mesh = folder.write("a.off", tetrahedron_off());
  EXPECT_THROW(read(folder, with_object(R"("mesh": ")" + mesh.string() + R"(")")), Bad_scene);
}

TEST(Bad_scene_file, a_sibling_folder_whose_name_starts_with_the_folder_s_is_refused) {
  const Temporary_folder folder;
  for (const auto* name : {"scenes", "scenes_secret"}) create_directory(folder.path() / name);
  folder.write("scenes_secret/a.off", tetrahedron_off());
  const auto scene = folder.write("scenes/scene.json", with_object(R"("mesh": "../scenes_secret/a.off")"));
  EXPECT_THROW(read_scene(scene), Bad_scene);
}

TEST(Bad_scene_file, links_that_lead_outside_are_refused) {
  const Temporary_folder outside;
  outside.write("a.off", tetrahedron_off());
  const Temporary_folder folder;
  std::filesystem::create_symlink(outside.path() / "a.off", folder.path() / "file.off");
  std::filesystem::create_directory_symlink(outside.path(), folder.path() / "folder");
  EXPECT_THROW(read(folder, with_object(R"("mesh": "file.off")")), Bad_scene);
  EXPECT_THROW(read(folder, with_object(R"("mesh": "folder/a.off")")), Bad_scene);
}

TEST(Bad_scene_file, cyclic_links_are_refused) {
  const Temporary_folder folder;
  std::filesystem::create_symlink("loop.off", folder.path() / "loop.off");
  EXPECT_THROW(read(folder, with_object(R"("mesh": "loop.off")")), Bad_scene);
}

TEST(Bad_scene_file, file_names_with_a_null_character_are_refused) {
  EXPECT_EQ(error_of(with_object(R"("mesh": "a.off\u0000.txt")")),
            R"(scene.json: /objects/0/mesh: "a.off\u0000.txt" has a control character)");
}

TEST(Bad_scene_file, missing_and_broken_meshes_keep_their_own_error) {
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

// ---- JSON ----

TEST(Bad_scene_file, syntax_errors_have_line_and_column) {
  EXPECT_EQ(error_of("{\n  \"objects\": [,]\n}").substr(0, 17), "scene.json:2:15: ");
  EXPECT_EQ(error_of("{\"a\" 1}").substr(0, 16), "scene.json:1:6: ");
  EXPECT_EQ(error_of("").substr(0, 16), "scene.json:1:1: ");
  EXPECT_EQ(error_of("{\"objects\": [{\"name\": \"a\"}]} x").substr(0, 17), "scene.json:1:30: ");
}

TEST(Bad_scene_file, text_that_is_not_json_is_refused) {
  for (const std::string bad : {"NaN", "Infinity", "// x", "\"\xff\"", "{'a': 1}", "01"}) {
    const std::string message = error_of(bad);
    EXPECT_TRUE(message.starts_with("scene.json:1:")) << message;
  }
}

TEST(Bad_scene_file, duplicate_keys_are_refused) {
  EXPECT_EQ(error_of(R"({"objects": [], "objects": []})"), R"(scene.json: /: duplicate key "objects")");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a"}, {"name": "b", "mesh": "a.off", "name": "c"}]})"),
            R"(scene.json: /objects/1: duplicate key "name")");
  EXPECT_EQ(error_of(R"({"x": [[1, {}], 2, {"y": {"z": 1, "z": 1}}]})"), R"(scene.json: /x/2/y: duplicate key "z")");
}

TEST(Bad_scene_file, deep_nesting_is_refused) {
  for (const std::string open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += open;
    EXPECT_NE(error_of(text).find("is nested deeper than 128 levels"), std::string::npos);
  }
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  EXPECT_NE(error_of(nested(129)).find("is nested deeper than 128 levels"), std::string::npos);
  EXPECT_EQ(error_of(nested(128)).find("is nested deeper"), std::string::npos);
  EXPECT_NE(error_of(std::string(100'000, '[') + std::string(100'000, ']')).find("is nested deeper than 128 levels"),
            std::string::npos);
}

TEST(Bad_scene_file, missing_irregular_and_huge_scene_files_are_refused) {
  const Temporary_folder folder;
  const auto message_of = [](const std::filesystem::path& file) {
    try {
      read_scene(file);
    } catch (const Bad_scene& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message_of(folder.path() / "none.json"),
            (folder.path() / "none.json").string() + ": there is no such file");
  EXPECT_EQ(message_of(folder.path()), folder.path().string() + ": is not a regular file");
  EXPECT_EQ(message_of("/dev/zero"), "/dev/zero: is not a regular file");
  const auto huge = folder.write("huge.json", "");
  std::filesystem::resize_file(huge, std::uintmax_t{1} << 40U);
  EXPECT_EQ(message_of(huge), huge.string() + ": is longer than 16 MiB, too long for a scene");
}

TEST(Bad_scene_file, ignored_names_of_no_object_are_refused) {
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": [["a", "a"], ["a", "A"]]})"),
            R"(scene.json: /ignore/1/1: there is no object "A")");
  EXPECT_EQ(error_of(R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": [["a"]]})"),
            "scene.json: /ignore/0: expected the names of two objects");
}

}  // namespace
}  // namespace lodestone
