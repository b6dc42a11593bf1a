// SPDX-License-Identifier: GPL-3.0-or-later
// `detect --closest`
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/run_program.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// Three frames: a corner of the unit cube, and another that is 8, 2 and 4 beyond it.
class Closest : public testing::Test {
 protected:
  Closest() {
    folder.write("still.off", tetrahedron_off());
    int frame = 0;
    for (const int x : {9, 3, 5}) folder.write("f" + std::to_string(frame++) + ".off", tetrahedron_off(x));
  }
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  Program_result detect(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "detect");
    arguments.insert(arguments.end(), {"--closest", "--out", path("out")});
    return run_program(arguments);
  }
  std::vector<Json> frames() const { return read_json_lines(folder.path() / "out" / "frames.jsonl"); }

  Temporary_folder folder;
};

TEST_F(Closest, faces_of_a_pair_are_listed_in_every_frame_however_far_apart) {
  expect_success(detect({path("still.off"), path("f#.off")}));
  const auto lines = frames();
  ASSERT_EQ(lines.size(), 3U);
  const std::vector<double> distances{8, 2, 4};
  for (std::size_t frame = 0; frame < 3; ++frame) {
    EXPECT_TRUE(lines[frame]["pairs"].empty());
    ASSERT_EQ(lines[frame]["closest"].size(), 1U);
    const Json& closest = lines[frame]["closest"][0];
    EXPECT_EQ(closest["a"], "still");
    EXPECT_EQ(closest["b"], "f");
    EXPECT_NEAR(closest["distance"].get<double>(), distances[frame], 1e-8);
    EXPECT_EQ(closest["points"][0], Json({1, 0, 0}));
    EXPECT_EQ(closest["points"][1], Json({distances[frame] + 1, 0, 0}));
  }
}

TEST_F(Closest, faces_have_their_numbers_in_the_file) {
  const auto quads =
      folder.write("q.off", "OFF\n6 2 0\n0 0 5\n1 0 5\n1 1 5\n0 1 5\n2 0 9\n2 1 9\n4 1 4 5 2\n4 0 1 2 3\n");
  const auto needle = folder.write("n.off", "OFF\n3 1 0\n0.4 0.6 5.5\n0.2 0.6 20\n0.3 0.5 20\n3 0 1 2\n");
  EXPECT_EQ(detect({quads.string(), needle.string()}).exit_code, 0);
  EXPECT_EQ(frames().at(0)["closest"][0]["faces"], Json({1, 0}));
}

TEST_F(Closest, distance_of_objects_that_collide_is_zero) {
  expect_success(detect({path("still.off"), path("still.off")}));
  EXPECT_EQ(frames().at(0)["closest"][0]["distance"], 0);
}

TEST_F(Closest, least_distance_and_its_frame_are_in_the_table_the_summary_and_the_line) {
  const std::vector<std::string> inputs{path("still.off"), path("f#.off"), path("f0.off")};
  const auto table = detect(inputs).out;
  EXPECT_NE(table.find("| least distance | in frame |"), std::string::npos) << table;
  EXPECT_NE(table.find("|              2 |        1 |"), std::string::npos) << table;
  const Json pairs = read_json(folder.path() / "out" / "summary.json")["pairs"];
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_NEAR(pairs[0]["least_distance"].get<double>(), 2, 1e-8);
  EXPECT_EQ(pairs[0]["least_distance_frame"], 1);
  EXPECT_EQ(pairs[2]["least_distance"], 0) << "f in its first frame is f0";
  EXPECT_EQ(pairs[2]["least_distance_frame"], 0);
  const auto line = detect({path("still.off"), path("f#.off"), "--quiet"}).out;
  EXPECT_EQ(line, "meshes: 0 colliding pairs in 3 frames; least distance 2 in frame 1, of still and f\n");
}

TEST_F(Closest, pairs_that_do_not_meet_are_left_out) {
  const auto scene = folder.write("scene.json", R"({"objects": [
    {"name": "a", "mesh": "still.off", "groups": ["x"], "meets": ["y"]}, {"name": "b", "mesh": "f0.off"},
    {"name": "c", "mesh": "f1.off", "groups": ["y"]}, {"name": "d", "mesh": "f2.off"}],
    "ignore": [["b", "d"], ["c", "d"]]})");
  expect_success(detect({scene.string()}));
  const auto lines = frames();
  std::vector<std::string> pairs;
  for (const auto& pair : lines.at(0)["closest"])
    pairs.push_back(pair["a"].get<std::string>() + pair["b"].get<std::string>());
  EXPECT_EQ(pairs, (std::vector<std::string>{"ac", "bc"}));
}

TEST_F(Closest, faces_are_found_by_mode_exact_alone) {
  expect_error(detect({path("still.off"), path("f0.off"), "--mode", "particles"}), 2, "--closest needs --mode exact");
}

TEST_F(Closest, pairs_are_absent_unless_asked_for) {
  expect_success(run_program({"detect", path("still.off"), path("f0.off"), "--out", path("out")}));
  EXPECT_FALSE(frames().at(0).contains("closest"));
}

}  // namespace
}  // namespace lodestone::test
