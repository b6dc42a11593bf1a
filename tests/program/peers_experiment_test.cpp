// SPDX-License-Identifier: GPL-3.0-or-later
// The experiment `peers`, where it is built.
#include <gtest/gtest.h>

#include <algorithm>

#include "program/run_program.h"
#include "runner/experiments.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Peers_experiment : public testing::Test {
 protected:
  void SetUp() override {
    if (std::ranges::none_of(experiments(), [](const auto& e) { return e.name == "peers"; }))
      GTEST_SKIP() << "built without LODESTONE_BUILD_PEERS";
    folder.write("tiny.json", R"({"frames": 4, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 5}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 0, "at": [1.9, 1.2, 0]}, {"frame": 3, "at": [1.6, 0, 0]}]}}]}}]})");
  }
  Program_result run(const std::string& only) const {
    return run_program(
        {"experiment", "peers", "--scenes", folder.path().string(), "--only", only, "--out", out.string()});
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Peers_experiment, writes_a_row_for_every_library) {
  expect_success(run("tiny"));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"peers.json", "peers.md"}));
  const auto figures = read_json(out / "peers.json");
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0]["scene"], "tiny");
  std::set<std::string> libraries;
  for (const auto& entry : figures[0]["entries"]) {
    libraries.insert(entry["library"]);
    EXPECT_GT(entry["passes"], 0);
  }
  for (const char* library : {"bound", "CGAL", "FCL", "Embree", "Bullet", "ODE"})
    EXPECT_TRUE(libraries.contains(library)) << library;
  const auto report = read_bytes(out / "peers.md");
  EXPECT_NE(report.find("## tiny"), std::string::npos) << report;
  EXPECT_NE(report.find("wrong yes/no"), std::string::npos) << report;
}

TEST_F(Peers_experiment, writes_the_cost_of_first_answers) {
  expect_success(run_program({"experiment", "first_answer", "--only", "tenth,1280", "--out", out.string()}));
  const auto figures = read_json(out / "first_answer.json");
  ASSERT_EQ(figures.size(), 1U);
  for (const auto& scene : figures) {
    EXPECT_EQ(scene["triangles"], 1280);
    const auto& calls = scene["entries"][0];
    EXPECT_EQ(calls["method"], "find_collisions");
    EXPECT_EQ(calls["right"], true);
    EXPECT_GT(calls["yes_no"]["first_milliseconds"], 0);
  }
  EXPECT_NE(read_bytes(out / "first_answer.md").find("## tenth, 1280 triangles each"), std::string::npos);
  expect_error(run_program({"experiment", "first_answer", "--only", "near", "--out", out.string()}), 2,
               "far, beside, touching");
}

TEST_F(Peers_experiment, refuses_a_scene_that_does_not_exist) {
  expect_error(run("tiny,huge"), 3, "huge.json");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

}  // namespace
}  // namespace lodestone::test
