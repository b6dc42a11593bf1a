// SPDX-License-Identifier: GPL-3.0-or-later
// `detect --impacts`
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

/// A corner of the unit cube, and another that flies through it along x without stopping inside.
class Impacts : public testing::Test {
 protected:
  Impacts() {
    folder.write("still.off", tetrahedron_off());
    int frame = 0;
    for (const int x : {4, 2, -6, -8}) folder.write("f" + std::to_string(frame++) + ".off", tetrahedron_off(x));
  }
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  Program_result detect(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "detect");
    arguments.insert(arguments.end(), {"--impacts", "--out", path("out")});
    return run_program(arguments);
  }
  std::vector<Json> frames() const { return read_json_lines(folder.path() / "out" / "frames.jsonl"); }
  Json pairs() const { return read_json(folder.path() / "out" / "summary.json")["pairs"]; }

  Temporary_folder folder;
};

TEST_F(Impacts, are_found_between_frames_that_do_not_collide) {
  expect_success(detect({path("still.off"), path("f#.off")}));
  const auto lines = frames();
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0]["impacts"], Json::array());
  ASSERT_EQ(lines[1]["impacts"].size(), 1U);
  const Json& impact = lines[1]["impacts"][0];
  EXPECT_EQ(impact["a"], "still");
  EXPECT_EQ(impact["b"], "f");
  EXPECT_EQ(impact["time"], 0.125);
  EXPECT_EQ(impact["point"], Json({1, 0, 0}));
  EXPECT_EQ(lines[2]["impacts"], Json::array());
  EXPECT_FALSE(lines[3].contains("impacts")) << "there is no next frame";
  const Json pair = pairs().at(0);
  EXPECT_EQ(pair["colliding_frames"], 0);
  EXPECT_EQ(pair["first_impact"], (Json{{"frame", 1}, {"time", 0.125}}));
  EXPECT_EQ(pair["passings"], 1);
}

TEST_F(Impacts, are_no_passings_where_the_objects_collide_before_or_after) {
  int frame = 0;
  for (const int x : {3, 1, -4}) folder.write("g" + std::to_string(frame++) + ".off", tetrahedron_off(x));
  expect_success(detect({path("still.off"), path("g#.off")}));
  EXPECT_EQ(frames()[0]["impacts"][0]["time"], 1);
  EXPECT_EQ(frames()[1]["impacts"][0]["time"], 0);
  EXPECT_EQ(pairs()[0]["first_impact"], (Json{{"frame", 0}, {"time", 1}}));
  EXPECT_EQ(pairs()[0]["passings"], 0);
}

TEST_F(Impacts, of_objects_that_never_meet_are_null) {
  folder.write("h0.off", tetrahedron_off(2));
  folder.write("h1.off", tetrahedron_off(3));
  expect_success(detect({path("still.off"), path("h#.off")}));
  EXPECT_EQ(frames()[0]["impacts"], Json::array());
  EXPECT_EQ(pairs(), Json::array());
}

TEST_F(Impacts, list_faces_by_their_numbers_in_the_file) {
  const auto quads =
      folder.write("q.off", "OFF\n6 2 0\n0 0 5\n1 0 5\n1 1 5\n0 1 5\n2 0 9\n2 1 9\n4 1 4 5 2\n4 0 1 2 3\n");
  for (const auto& [name, z] : {std::pair("n0.off", "7"), {"n1.off", "3"}})
    folder.write(name, "OFF\n3 1 0\n0.4 0.6 " + std::string(z) + "\n0.2 0.6 20\n0.3 0.5 20\n3 0 1 2\n");
  EXPECT_EQ(detect({quads.string(), path("n#.off")}).exit_code, 0);
  EXPECT_EQ(frames()[0]["impacts"][0]["faces"], Json({1, 0}));
  EXPECT_EQ(frames()[0]["impacts"][0]["time"], 0.5);
}

TEST_F(Impacts, are_in_the_table_and_the_line) {
  const auto table = detect({path("still.off"), path("f#.off")}).out;
  EXPECT_NE(table.find("| first impact | passings |"), std::string::npos) << table;
  EXPECT_NE(table.find("|        1.125 |        1 |"), std::string::npos) << table;
  const auto line = detect({path("still.off"), path("f#.off"), "--quiet"}).out;
  EXPECT_EQ(line, "meshes: 0 colliding pairs in 4 frames; first impact at 1.125, of still and f; 1 passing\n");
  EXPECT_EQ(detect({path("still.off"), path("f#.off"), "--exit-code"}).exit_code, 1);
}

TEST_F(Impacts, of_pairs_that_do_not_meet_are_left_out) {
  const auto scene = folder.write("scene.json", R"({"objects": [
    {"name": "a", "mesh": "still.off"},
    {"name": "b", "mesh": "f0.off", "motion": {"sequence": "f#.off"}},
    {"name": "c", "mesh": "still.off"}],
    "ignore": [["a", "b"]]})");
  expect_success(detect({scene.string()}));
  const auto lines = frames();
  std::vector<std::string> met;
  for (const auto& impact : lines.at(1)["impacts"])
    met.push_back(impact["a"].get<std::string>() + impact["b"].get<std::string>());
  EXPECT_EQ(met, (std::vector<std::string>{"ac", "bc"}));
}

TEST_F(Impacts, within_one_object_are_found_with_self) {
  // Two triangles of one file; the second falls through the first.
  for (const auto& [name, z] : {std::pair("s0.off", "1"), {"s1.off", "-3"}})
    folder.write(name, "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 1 " + std::string(z) + "\n2 1 " + z + "\n1 2 " + z +
                           "\n3 0 1 2\n3 3 4 5\n");
  expect_success(detect({path("s#.off"), "--self"}));
  const auto lines = frames();
  ASSERT_EQ(lines.at(0)["impacts"].size(), 1U);
  EXPECT_EQ(lines[0]["impacts"][0]["a"], lines[0]["impacts"][0]["b"]);
  EXPECT_EQ(lines[0]["impacts"][0]["time"], 0.25);
  EXPECT_EQ(lines[0]["impacts"][0]["faces"], Json({0, 1}));
  EXPECT_EQ(pairs()[0]["passings"], 1);
}

TEST_F(Impacts, need_mode_exact_and_two_frames) {
  expect_error(detect({path("still.off"), path("f#.off"), "--mode", "particles"}), 2, "--impacts needs --mode exact");
  expect_error(detect({path("still.off"), path("f0.off")}), 2, "between frames");
}

TEST_F(Impacts, are_absent_unless_asked_for) {
  expect_success(run_program({"detect", path("still.off"), path("f#.off"), "--out", path("out")}));
  EXPECT_FALSE(frames()[1].contains("impacts"));
}

TEST_F(Impacts, are_the_same_in_mode_certified) {
  folder.write("spinning.json", R"({"frames": 12, "objects": [
    {"name": "knot", "shape": {"torus_knot": {}}, "motion": {"deform": [{"spin": {"degrees_per_frame": 11}}]}},
    {"name": "ball", "shape": {"icosphere": {"frequency": 4}}, "place": {"scale": 0.5, "translate": [0.6, 0.2, 0]},
     "motion": {"deform": [{"travel": {"way_points": [
       {"frame": 0, "at": [0, 0, 0]}, {"frame": 5, "at": [0.9, 0.3, 0.4]}, {"frame": 11, "at": [-1, 0.2, -0.3]}]}}]}}]})");
  expect_success(detect({path("spinning.json"), "--mode", "exact"}));
  const auto exact = frames();
  expect_success(detect({path("spinning.json"), "--mode", "certified"}));
  const auto certified = frames();
  std::size_t impacts = 0;
  for (std::size_t frame = 0; frame + 1 < exact.size(); ++frame) {
    EXPECT_EQ(certified.at(frame)["impacts"], exact[frame]["impacts"]) << frame;
    impacts += exact[frame]["impacts"].size();
  }
  EXPECT_GT(impacts, 2U);
}

}  // namespace
}  // namespace lodestone::test
