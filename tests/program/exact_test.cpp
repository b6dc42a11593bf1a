// SPDX-License-Identifier: GPL-3.0-or-later
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

class Exact : public testing::Test {
 protected:
  Program_result detect(const std::string& input, std::vector<std::string> options) const {
    options.insert(options.begin(), {"detect", input, "--mode", "exact", "--out", out.string()});
    return run_program(options);
  }
  std::vector<Json> frames() const { return read_json_lines(out / "frames.jsonl"); }
  std::string write(const std::string& name, const std::string& text) const {
    return folder.write(name, text).string();
  }
  /// Two deforming bodies that pass through each other, and a small one inside the second.
  std::string write_bodies() const {
    return write("bodies.json", R"({"name": "bodies", "frames": 10, "objects": [
      {"name": "knot", "shape": {"torus_knot": {"segments": 60, "sides": 6}},
       "motion": {"deform": [{"twist": {"degrees": 40, "period": 9}},
                             {"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [-4, 0, 0]},
                                                                          {"frame": 9, "at": [0, 0, 0]}]}}]}},
      {"name": "ball", "shape": {"icosphere": {"frequency": 6}}, "place": {"scale": 2}},
      {"name": "seed", "shape": {"icosphere": {"frequency": 3}}, "place": {"scale": 0.1}}]})");
  }
  /// A strip of three triangles, the last of which is folded through the first.
  std::string write_folded() const {
    return write("folded.json", R"({"objects": [{"name": "folded", "mesh": "folded.off"},
                                                {"name": "other", "mesh": "other.off"}]})");
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "results";
};

TEST_F(Exact, misses_nothing_on_a_deforming_scene) {
  const auto result = detect(write_bodies(), {"--contacts", "all", "--truth"});
  expect_success(result);
  std::size_t collisions = 0;
  for (const auto& frame : frames())
    for (const auto& pair : frame["pairs"]) {
      EXPECT_EQ(pair["collides"], pair["truth"]);
      collisions += pair["collides"] ? 1 : 0;
    }
  EXPECT_GT(collisions, 2U);
}

TEST_F(Exact, writes_the_same_bytes_for_any_number_of_threads) {
  const auto scene = write_bodies();
  const std::vector<std::string> options{"--contacts", "all", "--self", "--points", "--normals", "--containment"};
  expect_success(detect(scene, options));
  const auto expected = read_bytes(out / "frames.jsonl");
  for (const auto* threads : {"0", "2", "5"}) {
    auto with_threads = options;
    with_threads.insert(with_threads.end(), {"--threads", threads});
    expect_success(detect(scene, with_threads));
    EXPECT_EQ(read_bytes(out / "frames.jsonl"), expected) << threads;
  }
}

TEST_F(Exact, writes_the_same_bytes_where_threads_share_a_walk) {
  // Trees of some 800 leaves, with far more candidate pairs than one thread processes alone.
  const auto scene = write("large.json", R"({"frames": 3, "objects": [
      {"name": "left", "shape": {"icosphere": {"frequency": 62}}},
      {"name": "right", "shape": {"icosphere": {"frequency": 60}}, "motion": {"deform": [
        {"wobble": {"amplitude": 0.05, "waves": 3, "period": 7}},
        {"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [0.3, 0.1, 0]},
                                                     {"frame": 2, "at": [0.5, 0.2, 0.1]}]}}]}}]})");
  const std::vector<std::string> options{"--contacts", "all", "--self"};
  expect_success(detect(scene, options));
  for (const auto& frame : frames()) EXPECT_GT(frame["statistics"]["leaf_tests"], 1000);
  const auto expected = read_bytes(out / "frames.jsonl");
  for (const auto* threads : {"2", "3"}) {
    auto with_threads = options;
    with_threads.insert(with_threads.end(), {"--threads", threads});
    expect_success(detect(scene, with_threads));
    EXPECT_EQ(read_bytes(out / "frames.jsonl"), expected) << threads;
  }
}

TEST_F(Exact, reports_which_object_is_inside_which) {
  expect_success(detect(write_bodies(), {"--containment"}));
  const auto first = frames().at(0);
  bool seen = false;
  for (const auto& pair : first["pairs"])
    if (pair["a"] == "ball" && pair["b"] == "seed") {
      EXPECT_EQ(pair["inside"], "seed");
      EXPECT_EQ(pair["collides"], false);
      seen = true;
    }
  EXPECT_TRUE(seen);
}

TEST_F(Exact, reports_faces_of_one_object_that_intersect_each_other) {
  write("folded.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n0.2 0.2 -1\n0.2 0.2 1\n0.3 0.3 1\n3 0 1 2\n3 3 4 5\n");
  write("other.off", tetrahedron_off(9));
  expect_success(detect(write_folded(), {"--self", "--contacts", "all"}));
  const auto pairs = frames().at(0)["pairs"];
  ASSERT_EQ(pairs.size(), 2U) << pairs;
  EXPECT_EQ(pairs[0]["a"], "folded");
  EXPECT_EQ(pairs[0]["b"], "folded");
  EXPECT_EQ(pairs[0]["faces"], Json::array({{0, 1}}));
  EXPECT_EQ(pairs[1]["collides"], false);
}

TEST_F(Exact, reports_faces_within_a_distance_with_their_nearest_points_and_directions) {
  write("low.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n");
  write("high.off", "OFF\n3 1 0\n0 0 0.5\n2 0 0.5\n0 2 0.5\n3 0 1 2\n");
  const auto scene = write("two.json", R"({"objects": [{"name": "low", "mesh": "low.off"},
                                                       {"name": "high", "mesh": "high.off"}]})");
  expect_success(detect(scene, {"--within", "0.5"}));
  for (const auto& pair : frames().at(0)["pairs"]) EXPECT_EQ(pair["near"], false);
  const auto result = detect(scene, {"--within", "0.500001", "--points", "--normals"});
  expect_success(result);
  const auto pair = frames().at(0)["pairs"][0];
  EXPECT_EQ(pair["near"], true);
  EXPECT_EQ(pair["collides"], false);
  const auto summary = read_json(out / "summary.json")["pairs"][0];
  EXPECT_EQ(summary["near_frames"], 1);
  EXPECT_EQ(summary["colliding_frames"], 0);
  EXPECT_NE(result.out.find("| colliding | first | last | near |"), std::string::npos) << result.out;
  EXPECT_EQ(pair["faces"], Json::array({{0, 0}}));
  ASSERT_EQ(pair["points"][0].size(), 2U);
  EXPECT_EQ(pair["points"][0][0][2], 0.0);
  EXPECT_EQ(pair["points"][0][1][2], 0.5);
  EXPECT_EQ(pair["normals"].size(), 1U);
  EXPECT_EQ(pair["intersects"], Json::array({false}));
}

TEST_F(Exact, tells_which_faces_within_a_distance_intersect) {
  // The upright triangle cuts one of two; the other is near it.
  write("floor.off", "OFF\n6 2 0\n0 0 0\n2 0 0\n0 2 0\n0 0 3\n2 0 3\n0 2 3\n3 3 4 5\n3 0 1 2\n");
  write("wall.off", "OFF\n3 1 0\n0.5 0.5 -1\n0.5 0.5 2.75\n0.7 0.5 -1\n3 0 1 2\n");
  const auto scene = write("two.json", R"({"objects": [{"name": "floor", "mesh": "floor.off"},
                                                       {"name": "wall", "mesh": "wall.off"}]})");
  expect_success(detect(scene, {"--within", "0.5", "--contacts", "all", "--truth"}));
  const auto all = frames().at(0)["pairs"][0];
  EXPECT_EQ(all["faces"], Json::array({{0, 0}, {1, 0}}));
  EXPECT_EQ(all["intersects"], Json::array({false, true}));
  expect_success(detect(scene, {"--within", "0.5", "--contacts", "first"}));
  const auto first = frames().at(0)["pairs"][0];
  EXPECT_EQ(first["faces"], Json::array({{1, 0}}));
  EXPECT_EQ(first["intersects"], Json::array({true}));
  expect_success(detect(scene, {"--contacts", "all"}));
  EXPECT_FALSE(frames().at(0)["pairs"][0].contains("intersects"));
}

TEST_F(Exact, reports_faces_of_one_object_within_a_distance) {
  // Two sheets of one object that come near to each other, and drift apart again.
  const auto scene = write("cloth.json", R"({"frames": 3, "objects": [
      {"name": "cloth", "shape": {"cloth": {"columns": 12, "rows": 12}},
       "motion": {"deform": [{"bend": {"degrees": 350, "period": 4}}]}}]})");
  const auto result = detect(scene, {"--self", "--self-within", "0.08", "--contacts", "all"});
  expect_success(result);
  std::vector<bool> near;
  for (const auto& frame : frames()) {
    ASSERT_EQ(frame["pairs"].size(), 1U);
    near.push_back(frame["pairs"][0]["near"]);
    EXPECT_EQ(frame["pairs"][0]["collides"], false);
  }
  EXPECT_EQ(near, (std::vector<bool>{false, true, false}));
  EXPECT_EQ(read_json(out / "summary.json")["pairs"][0]["near_frames"], 1);
  EXPECT_NE(result.out.find("| near |"), std::string::npos) << result.out;
  const auto alone = detect(scene, {"--self-within", "0.08"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("--self"), std::string::npos) << alone.err;
}

TEST_F(Exact, reports_where_the_limit_dropped_contacts) {
  const auto scene = write_bodies();
  expect_error(run_program({"detect", scene, "--most-contacts", "3"}), 2, "--contacts all");
  expect_success(detect(scene, {"--contacts", "all", "--most-contacts", "3"}));
  std::size_t capped = 0;
  for (const auto& frame : frames())
    for (const auto& pair : frame["pairs"]) {
      EXPECT_LE(pair["faces"].size(), 3U);
      if (!pair.contains("capped")) continue;
      EXPECT_EQ(pair["faces"].size(), 3U);
      ++capped;
    }
  EXPECT_GT(capped, 0U);
}

TEST_F(Exact, options_of_another_mode_are_refused_in_one_line) {
  const auto scene = write_bodies();
  for (const auto& wrong : std::vector<std::vector<std::string>>{{"--within", "1"}, {"--self"}, {"--containment"}}) {
    auto arguments = wrong;
    arguments.insert(arguments.begin(), scene);
    const auto result = run_program(detect_by_particles(arguments));
    EXPECT_NE(result.exit_code, 0);
    EXPECT_NE(result.err.find("mode exact"), std::string::npos) << result.err;
  }
}

TEST_F(Exact, compares_collisions_with_the_truth_also_within_a_distance) {
  const auto scene = write_bodies();
  for (const auto* contacts : {"yes_no", "all"}) {
    expect_success(detect(scene, {"--truth", "--within", "0.5", "--contacts", contacts}));
    std::size_t colliding = 0, only_near = 0;
    for (const auto& frame : frames())
      for (const auto& pair : frame["pairs"]) {
        EXPECT_EQ(pair["collides"], pair["truth"]);
        if (pair["collides"]) {
          EXPECT_EQ(pair["near"], true);
        }
        colliding += pair["collides"] ? 1 : 0;
        only_near += pair["near"] && !pair["collides"] ? 1 : 0;
      }
    EXPECT_GT(colliding, 2U);
    EXPECT_GT(only_near, 0U);
    for (const auto& pair : read_json(out / "summary.json")["pairs"]) EXPECT_EQ(pair["truth"]["accuracy"], 1.0);
  }
}

TEST_F(Exact, names_nothing_near_without_a_distance) {
  expect_success(detect(write_bodies(), {}));
  for (const auto& frame : frames())
    for (const auto& pair : frame["pairs"]) EXPECT_FALSE(pair.contains("near"));
}

TEST_F(Exact, finds_self_collisions_of_a_single_mesh) {
  const auto cross =
      write("cross.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n0.2 0.2 -1\n0.2 0.2 1\n0.3 0.3 1\n3 0 1 2\n3 3 4 5\n");
  const auto bow = write("bow.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 3 4\n");
  expect_success(detect(cross, {"--self", "--contacts", "all"}));
  EXPECT_EQ(frames().at(0)["pairs"][0]["faces"], Json::array({{0, 1}}));
  // Two faces that share a vertex, of which the mesh has two copies.
  expect_success(detect(bow, {"--self", "--contacts", "all"}));
  EXPECT_EQ(frames().at(0)["pairs"][0]["collides"], false);
  const auto alone = detect(cross, {});
  EXPECT_NE(alone.exit_code, 0);
  EXPECT_NE(alone.err.find("--self"), std::string::npos) << alone.err;
}

TEST_F(Exact, skips_pairs_that_the_scene_ignores) {
  write("a.off", tetrahedron_off(0));
  const auto objects = R"("objects": [{"name": "a", "mesh": "a.off"}, {"name": "b", "mesh": "a.off"},
                                      {"name": "c", "mesh": "a.off"}])";
  const auto scene = write("three.json", "{" + std::string(objects) + R"(, "ignore": [["c", "a"], ["b", "b"]]})");
  for (const bool particles : {false, true}) {
    expect_success(particles ? run_program(detect_by_particles({scene, "--truth", "--out", out.string()}))
                             : detect(scene, {"--truth"}));
    const auto pairs = frames().at(0)["pairs"];
    ASSERT_EQ(pairs.size(), 2U) << pairs;
    EXPECT_EQ(pairs[0]["b"], "b");
    EXPECT_EQ(pairs[1]["a"], "b");
  }
  expect_success(detect(scene, {"--self"}));
  EXPECT_EQ(frames().at(0)["pairs"].size(), 4U);  // a and c with themselves, a with b, b with c
}

}  // namespace
}  // namespace lodestone::test
