// SPDX-License-Identifier: GPL-3.0-or-later
// The experiment `modes` on scenes small enough for a test.
#include <gtest/gtest.h>

#include "program/run_program.h"
#include "support/moving_mesh_files.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Modes_experiment : public testing::Test {
 protected:
  Program_result run(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments{"experiment",           "modes", "--scenes",
                                       folder.path().string(), "--out", out.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
  /// Two tetrahedra, of which one moves into the other.
  void write_real_motion(const std::string& name) const {
    const auto path = folder.path() / name;
    create_directory(path);
    write_moving_tetrahedron(path / "moving", 4, 3, -0.9);
    write_moving_tetrahedron(path / "still", 4);
  }
  void write_spheres(const std::string& name, int frequency = 3) const {
    folder.write(name + ".json", R"({"frames": 3, "objects": [
        {"name": "still", "shape": {"icosphere": {"frequency": )" +
                                     std::to_string(frequency) + R"(}}},
        {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
          {"path": "linear", "way_points": [{"frame": 0, "at": [2.5, 0, 0]}, {"frame": 2, "at": [1.6, 0, 0]}]}}]}}]})");
  }
  void write_single(const std::string& name) const {
    folder.write(name + ".json", R"({"objects": [{"name": "only", "shape": {"icosphere": {"frequency": 2}}}]})");
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Modes_experiment, plays_scene_files_and_real_motion_of_a_folder_in_the_order_of_their_names) {
  write_real_motion("b");
  write_spheres("a");
  write_spheres("c");
  expect_success(run());
  const auto figures = read_json(out / "modes.json");
  std::vector<std::string> scenes;
  for (const auto& row : figures) scenes.push_back(row["scene"]);
  constexpr std::size_t settings = 9;
  ASSERT_EQ(scenes.size(), 3 * settings);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    EXPECT_EQ(scenes[i], (std::vector<std::string>{"a", "b", "c"})[i / settings]);
  for (const auto& row : figures) {
    EXPECT_EQ(row["precision"], 1.0) << row;
    EXPECT_EQ(row["recall_per_play"].size(), 3U) << row;
    EXPECT_GT(row["face_pairs"], 0) << row;
    EXPECT_LE(row["face_pairs_found"], row["face_pairs"]) << row;
  }
  // The moving tetrahedron is at 3, 2.1, 1.2 and 0.3: it meets the other in the last of four frames; three plays.
  EXPECT_EQ(figures[settings]["positive"], 3);
  EXPECT_EQ(figures[settings]["frames"], 12);
}

TEST_F(Modes_experiment, plays_the_components_of_an_only_object_against_each_other) {
  create_directory(folder.path() / "pair");
  write_two_tetrahedra_in_one_mesh(folder.path() / "pair" / "both", 4);
  expect_success(run());
  // The moving tetrahedron is at 2.5, 1.5, 0.5 and -0.5: it meets the other in the last two frames; three plays.
  for (const auto& row : read_json(out / "modes.json")) EXPECT_EQ(row["positive"], 6) << row;
  const auto report = read_bytes(out / "modes.md");
  EXPECT_NE(report.find("one object per component"), std::string::npos) << report;
}

TEST_F(Modes_experiment, plays_a_mesh_without_a_point_cache_and_names_the_subfolders_that_it_does_not_play) {
  create_directory(folder.path() / "walk");
  create_directory(folder.path() / "objs");
  write_moving_tetrahedron(folder.path() / "walk" / "moving", 4, 3, -0.9);
  folder.write("walk/floor.off", tetrahedron_off());
  folder.write("objs/a.obj", "");
  expect_success(run());
  // The moving tetrahedron is at 3, 2.1, 1.2 and 0.3: it meets the other in the last of four frames; three plays.
  for (const auto& row : read_json(out / "modes.json")) EXPECT_EQ(row["positive"], 3) << row;
  const auto report = read_bytes(out / "modes.md");
  EXPECT_NE(report.find("\nNot played: the meshes in objs. "), std::string::npos) << report;
}

TEST_F(Modes_experiment, skips_scenes_without_two_objects_that_can_meet_and_names_them) {
  write_spheres("a");
  write_single("lonely");
  expect_success(run());
  for (const auto& row : read_json(out / "modes.json")) EXPECT_EQ(row["scene"], "a");
  const auto report = read_bytes(out / "modes.md");
  EXPECT_NE(report.find("Skipped, because no two of their objects can meet: lonely."), std::string::npos) << report;
}

TEST_F(Modes_experiment, refuses_a_folder_in_which_no_two_objects_can_meet) {
  write_single("lonely");
  expect_error(run(), 3, folder.path().string() + ": no scene has two objects that can meet: lonely");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Modes_experiment, refuses_a_folder_without_scenes) {
  expect_error(run(), 3, folder.path().string() + ": nothing to play");
}

TEST_F(Modes_experiment, reports_a_broken_scene_before_it_plays_another) {
  write_spheres("a");
  folder.write("z.json", "{}");
  expect_error(run(), 3, "z.json");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Modes_experiment, the_mode_exact_is_the_truth_of_scenes_with_more_than_20_000_triangles) {
  write_spheres("large", 32);
  write_spheres("small", 31);
  expect_success(run());
  const auto figures = read_json(out / "modes.json");
  for (const auto& row : figures)
    EXPECT_EQ(row["is_truth"], row["scene"] == "large" && row["mode"] == "exact") << row["setting"];
}

TEST_F(Modes_experiment, scenes_of_one_name_are_told_apart_by_a_number) {
  write_real_motion("a");
  write_spheres("a");
  expect_success(run());
  std::set<std::string> scenes;
  for (const auto& row : read_json(out / "modes.json")) scenes.insert(row["scene"]);
  EXPECT_EQ(scenes, (std::set<std::string>{"a", "a_2"}));
}

TEST_F(Modes_experiment, plays_the_named_scenes_only) {
  write_spheres("a");
  write_spheres("b");
  expect_success(run({"--only", "b"}));
  for (const auto& row : read_json(out / "modes.json")) EXPECT_EQ(row["scene"], "b");
  expect_error(run({"--only", "c"}), 3, "there is no scene c; the scenes are a, b");
}

}  // namespace
}  // namespace lodestone::test
