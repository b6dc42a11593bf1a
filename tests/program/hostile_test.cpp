// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/run_program.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/special_numbers.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// `text` with the first `from` replaced; `from` must occur.
std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// `bytes` with `values` written over them from `offset` on.
template <class T>
std::string patched(std::string bytes, std::size_t offset, std::initializer_list<double> values) {
  const auto raw = packed<T>(values);
  return bytes.replace(offset, raw.size(), raw);
}

/// A point cache of the square: at rest in every frame but the last, where the first coordinate is `last`.
std::string square_cache(int frames, double last, double points = 4) {
  auto bytes = std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, points}) + packed<float>({0, 1}) +
               packed<std::int32_t>({static_cast<double>(frames)});
  for (int frame = 0; frame < frames; ++frame)
    bytes += packed<float>({frame + 1 == frames ? last : 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  return bytes;
}

/// Offsets in the binary samples.
const std::size_t ply_body = square_ply_header("binary_little_endian").size();
const std::size_t ply_faces = ply_body + std::size_t{4} * 12;
constexpr std::size_t stl_count = 80, stl_first_corner = 84 + 12;

class Hostile_input : public testing::Test {
 protected:
  void SetUp() override { folder.write("good.off", square_off); }

  /// The program must refuse its inputs: exit code 3, one line that contains `part`, no result.
  void expect_refused(const std::vector<std::string>& inputs, const std::string& part) const {
    std::vector<std::string> arguments{"detect", "--mode", "particles", "--out", out.string()};
    arguments.insert(arguments.end(), inputs.begin(), inputs.end());
    expect_error(run_program(arguments, {.limit = std::chrono::seconds(20)}), 3, part);
    EXPECT_EQ(content_of(out), std::set<std::string>{});
  }
  /// A broken mesh, as the first and as the second of two.
  void expect_refused(const std::vector<Sample>& meshes) const {
    const auto good = (folder.path() / "good.off").string();
    for (const auto& [name, bytes] : meshes) {
      SCOPED_TRACE(name);
      const auto file = folder.write(name, bytes).string();
      expect_refused({file, good}, file);
      expect_refused({good, file}, file);
    }
  }
  void expect_scene_refused(const std::string& text, const std::string& part) const {
    expect_refused({folder.write("scene.json", text).string()}, part);
  }
  /// A scene of the square with these keys, besides another.
  static std::string scene_with(const std::string& keys) {
    return R"({"objects": [{"name": "good", "mesh": "good.off"}, {"name": "bad", )" + keys + "}]}";
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

// Meshes

TEST_F(Hostile_input, a_mesh_with_counts_too_large_for_the_file_is_refused) {
  expect_refused({{"many_vertices.off", changed(square_off, "4 2 0", "4000000000 2 0")},
                  {"many_faces.off", changed(square_off, "4 2 0", "4 40000000 0")},
                  {"overflow.off", changed(square_off, "4 2 0", "18446744073709551616 2 0")},
                  {"negative.off", changed(square_off, "4 2 0", "-4 2 0")},
                  {"text.ply", changed(square_ply(), "vertex 4", "vertex 4000000000")},
                  {"binary.ply", changed(square_ply(std::endian::little), "face 2", "face 40000000")},
                  {"big.ply", changed(square_ply(std::endian::big), "vertex 4", "vertex 99999999")},
                  {"huge.stl", patched<std::uint32_t>(square_binary_stl(), stl_count, {4294967295.0})}});
}

TEST_F(Hostile_input, a_truncated_mesh_is_refused) {
  for (const auto& [name, bytes] : all_squares()) {
    if (name.ends_with(".obj")) continue;  // has no counts: every prefix of such a file is complete
    const auto extension = std::filesystem::path(name).extension().string();
    expect_refused({{"half" + name, bytes.substr(0, bytes.size() / 2)},
                    {"almost" + name, bytes.substr(0, bytes.size() - (extension == ".off" ? 4 : 12))}});
  }
}

TEST_F(Hostile_input, a_vertex_index_out_of_range_is_refused) {
  expect_refused({{"a.off", changed(square_off, "3 0 2 3", "3 0 2 4")},
                  {"negative.off", changed(square_off, "3 0 2 3", "3 0 2 -1")},
                  {"a.obj", changed(square_obj, "f 1 3 4", "f 1 3 5")},
                  {"zero.obj", changed(square_obj, "f 1 3 4", "f 0 3 4")},
                  {"negative.obj", changed(square_obj, "f 1 3 4", "f -9 3 4")},
                  {"text.ply", changed(square_ply(), "3 0 2 3", "3 0 2 4")},
                  {"binary.ply", patched<std::int32_t>(square_ply(std::endian::little), ply_faces + 1, {1e9})},
                  {"minus.ply", patched<std::int32_t>(square_ply(std::endian::little), ply_faces + 1, {-1})}});
}

TEST_F(Hostile_input, a_non_finite_coordinate_is_refused) {
  expect_refused({{"nan.off", changed(square_off, "1 1 0", "1 nan 0")},
                  {"inf.off", changed(square_off, "1 1 0", "1 inf 0")},
                  {"large.off", changed(square_off, "1 1 0", "1 1e999 0")},
                  {"nan.obj", changed(square_obj, "v 1 1 0", "v nan 1 0")},
                  {"nan.ply", changed(square_ply(), "1 1 0", "1 1 -nan")},
                  {"binary.ply", patched<float>(square_ply(std::endian::little), ply_body, {not_a_number})},
                  {"inf.ply", patched<float>(square_ply(std::endian::little), ply_body + 8, {infinite})},
                  {"text.stl", changed(square_text_stl, "vertex 1 0 0", "vertex inf 0 0")},
                  {"binary.stl", patched<float>(square_binary_stl(), stl_first_corner, {not_a_number})}});
}

TEST_F(Hostile_input, a_face_of_too_few_corners_or_too_many_for_its_file_is_refused) {
  expect_refused({{"two.off", changed(square_off, "3 0 2 3", "2 0 2 3")},
                  {"a.off", changed(square_off, "3 0 2 3", "4 0 2 3")},
                  {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\n"},
                  {"a.ply", changed(square_ply(), "3 0 1 2", "2 0 1")},
                  {"binary.ply", patched<std::uint8_t>(square_ply(std::endian::little), ply_faces, {255})}});
}

TEST_F(Hostile_input, a_mesh_without_faces_is_refused) {
  expect_refused({{"no.off", ""},
                  {"no.obj", ""},
                  {"no.ply", ""},
                  {"no.stl", ""},
                  {"a.off", "OFF\n0 0 0\n"},
                  {"points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"},
                  {"a.obj", "v 0 0 0\n"},
                  {"a.ply", changed(changed(square_ply_header("ascii"), "vertex 4", "vertex 0"), "face 2", "face 0")},
                  {"a.stl", "solid a\nendsolid a\n"},
                  {"b.stl", std::string(84, '\0')}});
}

TEST_F(Hostile_input, a_file_of_another_kind_is_refused) {
  expect_refused({{"a.off", square_obj},
                  {"a.obj", square_binary_stl()},
                  {"a.ply", square_off},
                  {"a.stl", square_ply()},
                  {"a.xyz", square_off},
                  {"a", square_off},
                  {"zeros.off", std::string(10000, '\0')},
                  {"zeros.obj", std::string(10000, '\0')},
                  {"zeros.ply", std::string(10000, '\0')}});
}

TEST_F(Hostile_input, integer_coordinates_are_read_correctly) {
  const auto file = folder.write(
      "whole.ply",
      changed(changed(changed(square_ply(), "float x", "int x"), "float y", "short y"), "float z", "uchar z"));
  const auto needle = folder.write("needle.off", "OFF\n3 1 0\n0.7 0.2 -1\n0.7 0.2 1\n0.8 0.2 1\n3 0 1 2\n");
  expect_success(run_program(detect_by_particles(
      {file.string(), needle.string(), "--meetings", "0", "--collision-distance", "9", "--out", out.string()})));
  EXPECT_EQ(read_json_lines(out / "frames.jsonl").at(0)["pairs"].at(0)["faces"], nlohmann::json({{0, 0}}));
}

TEST_F(Hostile_input, a_missing_file_and_a_folder_are_refused) {
  const auto good = (folder.path() / "good.off").string();
  create_directory(folder.path() / "folder.off");
  create_directory(folder.path() / "folder.json");
  for (const auto* name : {"none.off", "folder.off"}) {
    expect_refused({(folder.path() / name).string(), good}, name);
    expect_refused({good, (folder.path() / name).string()}, name);
  }
  for (const auto* name : {"none.json", "folder.json"}) expect_refused({(folder.path() / name).string()}, name);
}

TEST_F(Hostile_input, pipes_devices_and_cyclic_links_are_refused) {
  const auto good = (folder.path() / "good.off").string();
  for (const std::string extension : {".off", ".json"}) {
    const auto pipe = folder.path() / ("pipe" + extension), zero = folder.path() / ("zero" + extension),
               circle = folder.path() / ("circle" + extension);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    create_symlink("/dev/zero", zero);
    create_symlink(circle, circle);
    for (const auto& file : {pipe, zero, circle}) {
      SCOPED_TRACE(file);
      std::vector<std::string> inputs{file.string()};
      if (extension == ".off") inputs.push_back(good);
      expect_refused(inputs, file.filename().string());
    }
  }
}

TEST_F(Hostile_input, a_file_name_of_several_lines_is_reported_on_one) {
  const auto file = folder.write("two\nlines.off", "rubbish");
  expect_refused({file.string(), file.string()}, "two?lines.off:1: ");
}

TEST_F(Hostile_input, a_file_name_longer_than_the_system_allows_is_refused) {
  const std::string name(300, 'x');
  expect_refused({name + ".off", (folder.path() / "good.off").string()}, name);
  expect_refused({name + ".json"}, name);
}

// Motions

TEST_F(Hostile_input, nan_in_a_later_frame_leaves_no_result) {
  for (const double bad : {not_a_number, infinite}) {
    folder.write("bad.pc2", square_cache(50, bad));
    expect_scene_refused(scene_with(R"("mesh": "good.off", "motion": {"pc2": "bad.pc2"})"), "bad.pc2: frame 49, ");
  }
}

TEST_F(Hostile_input, the_frames_before_a_bad_one_can_be_used) {
  folder.write("bad.pc2", square_cache(50, not_a_number));
  const auto file = folder.write("scene.json", R"({"frames": 49, "objects": [{"name": "good", "mesh": "good.off"},
    {"name": "bad", "mesh": "good.off", "motion": {"pc2": "bad.pc2"}}]})");
  expect_success(run_program(detect_by_particles({file.string(), "--out", out.string()})));
  EXPECT_EQ(read_json_lines(out / "frames.jsonl").size(), 49U);
}

TEST_F(Hostile_input, a_point_cache_that_does_not_match_its_mesh_is_refused) {
  const auto whole = square_cache(3, 0);
  for (const auto& bytes :
       {std::string(), std::string("POINTCACHE2"), "X" + whole.substr(1), whole.substr(0, 20),
        whole.substr(0, whole.size() - 1), square_cache(3, 0, 5), square_cache(3, 0, 0), square_cache(3, 0, -4),
        patched<std::int32_t>(whole, 28, {0}), patched<std::int32_t>(whole, 28, {-1}),
        patched<std::int32_t>(whole, 28, {2147483647}), patched<std::int32_t>(whole, 12, {2})}) {
    folder.write("bad.pc2", bytes);
    expect_scene_refused(scene_with(R"("mesh": "good.off", "motion": {"pc2": "bad.pc2"})"), "bad.pc2");
  }
  remove(folder.path() / "bad.pc2");
  expect_scene_refused(scene_with(R"("mesh": "good.off", "motion": {"pc2": "bad.pc2"})"), "bad.pc2");
}

TEST_F(Hostile_input, a_mesh_sequence_that_changes_or_is_incomplete_is_refused) {
  const std::string scene =
      scene_with(R"("mesh": "good.off", "motion": {"sequence": {"pattern": "f#.off", "first": 0, "last": 3}})");
  for (int i = 0; i < 4; ++i) folder.write("f" + std::to_string(i) + ".off", square_off);
  const std::string five = "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 0\n3 0 1 2\n3 0 2 3\n";
  for (const auto& bytes :
       {five, changed(square_off, "3 0 2 3", "3 0 1 3"), changed(square_off, "1 1 0", "1 nan 0"), std::string()}) {
    folder.write("f2.off", bytes);
    expect_scene_refused(scene, "f2.off");
  }
  remove(folder.path() / "f2.off");
  expect_scene_refused(scene, "f2.off");
}

// Scenes

TEST_F(Hostile_input, an_unknown_key_in_a_scene_is_refused) {
  expect_scene_refused(R"({"objcts": []})", R"(unknown key "objcts")");
  expect_scene_refused(scene_with(R"("mesh": "good.off", "colour": 3)"), R"(/objects/1: unknown key "colour")");
  expect_scene_refused(scene_with(R"("mesh": "good.off", "motion": {"pc": "a.pc2"})"), R"(unknown key "pc")");
}

TEST_F(Hostile_input, a_path_that_leaves_the_folder_of_the_scene_is_refused) {
  const Temporary_folder other;
  const auto outside = other.write("outside.off", square_off).string();
  create_symlink(outside, folder.path() / "link.off");
  create_directory_symlink(other.path(), folder.path() / "link");
  const auto relative = "../" + other.path().filename().string() + "/outside.off";
  for (const auto& path : {outside, relative, std::string("link.off"), std::string("link/outside.off"),
                           std::string("link/../../etc/passwd"), std::string("/etc/passwd")})
    expect_scene_refused(scene_with(R"("mesh": ")" + path + "\""), "is not inside the scene's folder");
}

TEST_F(Hostile_input, a_scene_that_is_not_json_is_refused) {
  for (const std::string text : {"", "{", "nonsense", "[]", "null", "3", R"({"objects": [}])", "{\"name\": \"\xff\"}",
                                 R"({"objects": 1e999})", "\xef\xbb\xbf", R"({"objects": [], "objects": []})"})
    expect_scene_refused(text, "scene.json");
  expect_scene_refused(std::string(1'000'000, '['), "deeper");
  expect_scene_refused(R"({"objects":)" + std::string(1'000'000, '['), "deeper");
  std::string keys;
  for (int i = 0; i < 100'000; ++i) keys += R"({"a":)";
  expect_scene_refused(keys, "deeper");
}

TEST_F(Hostile_input, a_number_out_of_range_is_refused) {
  for (const auto* frames : {"0", "-1", "1.5", "1e9", "1000000000", "99999999999999999999", "\"3\"", "null"})
    expect_scene_refused(
        std::string(R"({"frames": )") + frames + R"(, "objects": [{"name": "a", "mesh": "good.off"}]})", "/frames");
  for (const auto* particles : {"0", "-3", "1e18", "100001"})
    expect_scene_refused(scene_with(std::string(R"("mesh": "good.off", "particles": )") + particles), "/particles");
  expect_scene_refused(scene_with(R"("shape": {"icosphere": {"frequency": 100000}})"), "frequency");
  expect_scene_refused(scene_with(R"("mesh": "good.off", "place": {"scale": 1e308, "translate": [1e308, 1e308, 1e308]},
    "motion": {"deform": [{"inflate": {"factor": 1e308}}]})"),
                       "");
}

TEST_F(Hostile_input, a_duplicate_empty_or_unprintable_name_is_refused) {
  expect_scene_refused(R"({"objects": [{"name": "a", "mesh": "good.off"}, {"name": "a", "mesh": "good.off"}]})",
                       "taken");
  expect_scene_refused(R"({"objects": [{"name": "", "mesh": "good.off"}]})", "name");
  expect_scene_refused(R"({"objects": [{"name": "a\u001b[2J", "mesh": "good.off"}]})", "control character");
  expect_scene_refused(R"({"objects": []})", "empty");
}

TEST_F(Hostile_input, a_broken_mesh_in_a_scene_is_named) {
  folder.write("broken.off", "OFF\n4 2 0\n");
  expect_scene_refused(scene_with(R"("mesh": "broken.off")"), "broken.off:2: ");
  expect_scene_refused(scene_with(R"("mesh": "none.off")"), "none.off");
}

// Command lines

TEST_F(Hostile_input, an_invalid_command_line_is_refused) {
  const auto good = (folder.path() / "good.off").string();
  const std::vector<std::vector<std::string>> wrong{{},
                                                    {"frobnicate"},
                                                    {"--frobnicate"},
                                                    {"detect"},
                                                    {"detect", good},
                                                    {"detect", good, good, "--frobnicate"},
                                                    {"detect", good, good, "--mode", "guess"},
                                                    {"detect", good, good, "--mode", "1"},
                                                    {"detect", good, good, "--contacts", ""},
                                                    {"detect", good, good, "--contacts", "some"},
                                                    {"detect", good, good, "--candidates", "few"},
                                                    {"detect", good, good, "--split", "half"},
                                                    {"detect", good, good, "--particles", "-1"},
                                                    {"detect", good, good, "--particles", "1e3"},
                                                    {"detect", good, good, "--particles", "99999999999999999999"},
                                                    {"detect", good, good, "--seed", "x"},
                                                    {"detect", good, good, "--out"},
                                                    {"detect", good, good, "--out", ""},
                                                    {"detect", good, good, "two\nlines\n--quiet", "--mode", "a\nb"},
                                                    {"partition"},
                                                    {"partition", good, good},
                                                    {"experiment"},
                                                    {"experiment", "no_such_experiment"}};
  for (const auto& arguments : wrong) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_error(run_program(arguments), 2, "");
  }
}

TEST_F(Hostile_input, an_invalid_distance_is_refused) {
  const auto good = (folder.path() / "good.off").string();
  const std::vector<std::vector<std::string>> methods{
      {"--growth"}, {"--opening-reach"}, {"--meetings", "0", "--collision-distance"}};
  for (const auto& method : methods)
    for (const auto* value : {"nan", "-nan", "0", "-1", "-inf", "far"}) {
      SCOPED_TRACE(method.back() + " " + value);
      std::vector<std::string> arguments{good, good, "--out", out.string()};
      arguments.insert(arguments.end(), method.begin(), method.end());
      arguments.emplace_back(value);
      const auto result = run_program(detect_by_particles(arguments));
      expect_error(result, 2, method.back() + ": ");
      EXPECT_LT(result.err.size(), 150U) << result.err;
      EXPECT_EQ(content_of(out), std::set<std::string>{});
    }
  expect_error(run_program(detect_by_particles({good, good, "--meetings", "0", "--collision-distance", "inf"})), 2,
               "finite");
}

TEST_F(Hostile_input, an_invalid_option_value_is_refused_with_the_valid_ones) {
  const auto good = (folder.path() / "good.off").string();
  expect_error(run_program({"detect", good, good, "--mode", "guess"}), 2, "particles or senin, found 'guess'");
  expect_error(run_program({"detect", good, good, "--particles", "1000001"}), 2, "1000001 not in range 0 to 1000000");
}

}  // namespace
}  // namespace lodestone::test
