// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "program/run_program.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

TEST(Certified_experiment, measures_characters_and_scenes_with_promises) {
  const Temporary_folder folder;
  folder.write("tiny.json", R"({"frames": 4, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 12}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 12}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 0, "at": [2.05, 0, 0]}, {"frame": 3, "at": [1.95, 0, 0]}]}}]}}]})");
  const auto out = folder.path() / "out";
  expect_success(run_program({"experiment", "certified", "--scenes", folder.path().string(), "--only",
                              "hands,knots,5000,tiny", "--out", out.string()}));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"certified.json", "certified.md"}));
  const auto figures = read_json(out / "certified.json");
  ASSERT_EQ(figures["characters"].size(), 2U);
  for (const auto& scene : figures["characters"]) {
    EXPECT_EQ(scene["entries"][0]["method"], "certified");
    EXPECT_EQ(scene["entries"][0]["wrong_sets"], 0);
    EXPECT_EQ(scene["broken"], 0);
    EXPECT_GT(scene["colliding"], 0);
    EXPECT_GE(scene["tightness"], 1);
  }
  ASSERT_EQ(figures["promises"].size(), 1U);
  const auto& tiny = figures["promises"][0];
  EXPECT_GT(tiny["colliding"], 0);
  EXPECT_LT(tiny["colliding"], 4);
  ASSERT_EQ(tiny["promises"].size(), 3U);
  for (const auto& promise : tiny["promises"]) {
    EXPECT_EQ(promise["wrong_answers"], 0);
    EXPECT_EQ(promise["wrong_sets"], 0);
    EXPECT_EQ(promise["broken"], 0);
  }
  EXPECT_LT(tiny["promises"][0]["yes_no_read_median"], tiny["exact"]["yes_no_read_median"]);
  EXPECT_NE(read_bytes(out / "certified.md").find("## Scenes with promises"), std::string::npos);
}

TEST(Certified_experiment, finds_an_unknown_name_before_it_plays_anything) {
  expect_error(run_program({"experiment", "certified", "--only", "hands,4000000,nosuch"}), 3, "there is no such scene");
}

TEST(Certified_experiment, writes_its_characters_and_plays_those_of_another_folder) {
  const Temporary_folder folder;
  const auto characters = folder.path() / "characters";
  expect_success(run_program({"experiment", "certified", "--write-meshes", characters.string()}));
  EXPECT_EQ(content_of(characters), (std::set<std::string>{"body.glb", "face.glb", "hand.glb"}));
  std::filesystem::remove(characters / "body.glb");
  std::filesystem::remove(characters / "face.glb");
  std::filesystem::rename(characters / "hand.glb", characters / "paw.glb");
  const auto out = folder.path() / "out";
  expect_success(run_program(
      {"experiment", "certified", "--scenes", characters.string(), "--only", "paw,5000", "--out", out.string()}));
  const auto figures = read_json(out / "certified.json");
  ASSERT_EQ(figures["characters"].size(), 1U);
  EXPECT_EQ(figures["characters"][0]["scene"], "paw");
}

}  // namespace
}  // namespace lodestone::test
