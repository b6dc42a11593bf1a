// SPDX-License-Identifier: GPL-3.0-or-later
// The experiments `defaults` and `nested_codebook` on a scene small enough for a test.
#include <gtest/gtest.h>

#include "program/run_program.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Particle_experiments : public testing::Test {
 protected:
  /// Unit spheres 2.5, 2.05 and 1.6 apart: the last frame collides.
  void SetUp() override {
    folder.write("tiny.json", R"({"frames": 3, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 5}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 0, "at": [2.5, 0, 0]}, {"frame": 2, "at": [1.6, 0, 0]}]}}]}}]})");
  }
  nlohmann::json figures_of(const std::string& experiment) const {
    expect_success(run_program(
        {"experiment", experiment, "--scenes", folder.path().string(), "--only", "tiny", "--out", out.string()}));
    EXPECT_EQ(content_of(out), (std::set<std::string>{experiment + ".json", experiment + ".md"}));
    return read_json(out / (experiment + ".json"));
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Particle_experiments, defaults_measures_every_setting_in_three_plays) {
  const auto figures = figures_of("defaults");
  std::set<std::string> settings;
  for (const auto& row : figures) {
    settings.insert(row["setting"]);
    EXPECT_EQ(row["scene"], "tiny");
    EXPECT_EQ(row["frames"], 3 * 3);
    EXPECT_EQ(row["positive"], 3);
    EXPECT_EQ(row["precision"], 1.0);
  }
  EXPECT_EQ(settings.size(), figures.size());
  for (const char* name : {"12 particles", "automatic", "normals x 0.5", "growth 1.5", "no openings, 12 particles"})
    EXPECT_TRUE(settings.contains(name)) << name;
  const auto report = read_bytes(out / "defaults.md");
  EXPECT_NE(report.find("| 12 particles "), std::string::npos) << report;
}

TEST_F(Particle_experiments, nested_codebook_finds_the_collision_of_rigid_spheres_with_every_hierarchy) {
  std::size_t medians = 0;
  for (const auto& row : figures_of("nested_codebook")) {
    EXPECT_EQ(row["colliding"], 1);
    if (row["reach"] == 1.0) {
      EXPECT_EQ(row["reached"], 1);
      EXPECT_EQ(row["face_pairs_reached"], row["face_pairs"]);
    }
    medians += row["hierarchy"] == "median" ? 1 : 0;
  }
  EXPECT_EQ(medians, 8U);  // with regions and without, two sizes of leaves, two reaches
  const auto report = read_bytes(out / "nested_codebook.md");
  EXPECT_NE(report.find("below 12 regions, with a reach of 1"), std::string::npos) << report;
}

TEST_F(Particle_experiments, refuse_a_scene_that_does_not_exist) {
  for (const char* experiment : {"defaults", "nested_codebook"})
    expect_error(run_program({"experiment", experiment, "--scenes", folder.path().string(), "--only", "none", "--out",
                              out.string()}),
                 3, "none.json: there is no such scene; the scenes are tiny");
  const Temporary_folder empty;
  expect_error(run_program({"experiment", "defaults", "--scenes", empty.path().string(), "--only", "none", "--out",
                            out.string()}),
               3, "none.json: there is no such scene; the folder has no scene files");
}

}  // namespace
}  // namespace lodestone::test
