// SPDX-License-Identifier: GPL-3.0-or-later
// The experiment `volumes` on a scene small enough for a test.
#include <gtest/gtest.h>

#include <tuple>

#include "lodestone/volumes/all.h"
#include "program/run_program.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

template <class... Volumes>
std::set<std::string> names_of(std::tuple<Volumes...>*) {
  return {std::string(Volumes::name)...};
}

class Volumes_experiment : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("tiny.json", R"({"frames": 4, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 8}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 7}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 0, "at": [1.9, 1.2, 0]}, {"frame": 3, "at": [1.6, 0, 0]}]}}]}}]})");
  }
  Program_result run(const std::string& only) const {
    return run_program(
        {"experiment", "volumes", "--scenes", folder.path().string(), "--only", only, "--out", out.string()});
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Volumes_experiment, writes_a_row_for_every_volume_strategy_and_number_of_particles) {
  expect_success(run("tiny"));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"volumes.json", "volumes.md"}));
  const auto figures = read_json(out / "volumes.json");
  std::set<std::pair<std::string, std::string>> expected{{"bound", ""}}, found;
  for (const auto& model : names_of(static_cast<Bounding_volumes*>(nullptr)))
    for (const char* strategy : {"lbg", "lbg_position", "median_split", "vsa"}) expected.insert({model, strategy});
  for (const char* particles : {"particles, 12", "particles, 32", "particles, 64"}) expected.insert({particles, "lbg"});
  for (const auto& row : figures["rows"]) {
    EXPECT_EQ(row["scene"], "tiny");
    found.emplace(row["model"].get<std::string>(), row["strategy"].get<std::string>());
    EXPECT_GT(row["update_ms"], 0) << row;
    if (row["kind"] != "volume") continue;
    EXPECT_EQ(row["missed"], 0) << row;
    EXPECT_EQ(row["wrong_sets"], 0) << row;
    EXPECT_GT(row["volume_tests"], 0) << row;
    EXPECT_GT(row["update_and_all_pairs_over_aabb"], 0) << row;
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(figures["tightness"].size(), 8 * (expected.size() - 4));
  for (const auto& row : figures["tightness"]) EXPECT_GT(row["tightness"], 0) << row;
}

TEST_F(Volumes_experiment, reports_ratios_over_all_scenes_and_a_section_for_each) {
  folder.write("copy.json", read_bytes(folder.path() / "tiny.json"));
  expect_success(run("tiny,copy"));
  const auto report = read_bytes(out / "volumes.md");
  for (const char* part :
       {"Update, in times of aabb", "of 32 particles", "## tiny", "## copy", "Tightness", "particles, 64"})
    EXPECT_NE(report.find(part), std::string::npos) << part << " is not in\n" << report;
}

TEST_F(Volumes_experiment, refuses_a_scene_that_does_not_exist) {
  expect_error(run("tiny,huge"), 3, "huge.json");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

}  // namespace
}  // namespace lodestone::test
