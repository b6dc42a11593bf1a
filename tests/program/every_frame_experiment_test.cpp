// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program/run_program.h"
#include "support/moving_mesh_files.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

TEST(Every_frame_experiment, counts_what_it_checked_in_each_scene) {
  const Temporary_folder folder;
  // The two boxes are apart in frame 0, overlap in frame 1, and the spheres meet in frames 2 and 3.
  folder.write("tiny.json", R"({"frames": 4, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 5}}},
      {"name": "far", "shape": {"icosphere": {"frequency": 2}}, "place": {"translate": [50, 0, 0]}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 0, "at": [5, 0, 0]}, {"frame": 1, "at": [1.5, 1.5, 1]},
                                          {"frame": 2, "at": [1.5, 0, 0]}]}}]}}]})");
  const auto out = folder.path() / "out";
  expect_success(run_program(
      {"experiment", "every_frame", "--scenes", folder.path().string(), "--only", "tiny", "--out", out.string()}));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"every_frame.json", "every_frame.md"}));
  const auto figures = read_json(out / "every_frame.json");
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0]["scene"], "tiny");
  EXPECT_EQ(figures[0]["frames"], 4);
  EXPECT_EQ(figures[0]["object_pairs"], 4 * 3);
  EXPECT_EQ(figures[0]["intersecting"], 2);
  EXPECT_GT(figures[0]["face_pairs"], 20);
  EXPECT_EQ(figures[0]["wrong_answers"], 0);
  EXPECT_EQ(figures[0]["wrong_sets"], 0);
}

TEST(Every_frame_experiment, gives_the_same_files_in_shards) {
  const Temporary_folder folder;
  for (const std::string name : {"a", "b"})
    folder.write(name + ".json", R"({"frames": 7, "objects": [
        {"name": "still", "shape": {"icosphere": {"frequency": 5}}},
        {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
          {"path": "linear", "way_points": [{"frame": 0, "at": [5, 0, 0]}, {"frame": 6, "at": [1.4, 0, 0]}]}}]}}]})");
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words{"experiment", "every_frame", "--scenes", folder.path().string(),
                                   "--only",     "b,a",         "--out",    (folder.path() / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    expect_success(run_program(words));
  };
  run("whole", {});
  for (const std::string shard : {"3/4", "1/4", "4/4", "2/4"}) run("parts", {"--shard", shard});
  expect_success(run_program({"merge", (folder.path() / "parts").string(), "--quiet"}));
  for (const std::string file : {"every_frame.json", "every_frame.md"})
    EXPECT_EQ(read_bytes(folder.path() / "parts" / file), read_bytes(folder.path() / "whole" / file));
}

TEST(Every_frame_experiment, keeps_scenes_of_one_name_apart) {
  const Temporary_folder folder;
  const auto write = [&](const std::string& file, int frames, int frequency) {
    folder.write(file, fmt::format(R"({{"name": "same", "frames": {}, "objects": [
        {{"name": "p", "shape": {{"icosphere": {{"frequency": {}}}}}}},
        {{"name": "q", "shape": {{"icosphere": {{"frequency": 2}}}}, "place": {{"translate": [1.5, 0, 0]}}}}]}})",
                                   frames, frequency));
  };
  write("a.json", 3, 2), write("b.json", 5, 2);
  const std::vector<std::string> words{"experiment",           "every_frame", "--scenes",
                                       folder.path().string(), "--out",       (folder.path() / "out").string()};
  expect_success(run_program(words));
  const auto figures = read_json(folder.path() / "out/every_frame.json");
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0]["scene"], "same");
  EXPECT_EQ(figures[0]["frames"], 3);
  EXPECT_EQ(figures[1]["scene"], "same_2");
  EXPECT_EQ(figures[1]["frames"], 5);

  const auto shard = [&](const std::string& part) {
    auto shard_words = words;
    shard_words.back() += "_of_shards";
    shard_words.insert(shard_words.end(), {"--shard", part});
    return run_program(shard_words);
  };
  expect_success(shard("1/2"));
  write("a.json", 3, 3);
  expect_error(shard("2/2"), 2, "these are shards of other work: inputs is ");
}

TEST(Every_frame_experiment, plays_real_motion_with_and_without_only) {
  const Temporary_folder folder;
  for (const std::string name : {"far", "walk"}) {
    create_directory(folder.path() / name);
    write_moving_tetrahedron(folder.path() / name / "moving", 4, 3, name == "walk" ? -0.9 : 0);
    write_moving_tetrahedron(folder.path() / name / "still", 4);
  }
  const auto scenes_of = [&](const std::vector<std::string>& more) {
    const auto out = folder.path() / "out";
    std::vector<std::string> words{"experiment",           "every_frame", "--scenes",
                                   folder.path().string(), "--out",       out.string()};
    words.insert(words.end(), more.begin(), more.end());
    expect_success(run_program(words));
    std::vector<std::string> scenes;
    for (const auto& row : read_json(out / "every_frame.json")) {
      scenes.push_back(row["scene"]);
      // The moving tetrahedron is at 3, 2.1, 1.2 and 0.3: it meets the other in the last of four frames.
      EXPECT_EQ(row["intersecting"], scenes.back() == "walk" ? 1 : 0);
    }
    return scenes;
  };
  create_directory(folder.path() / "objs");
  folder.write("objs/a.obj", "");
  EXPECT_EQ(scenes_of({}), (std::vector<std::string>{"far", "walk"}));
  EXPECT_NE(read_bytes(folder.path() / "out/every_frame.md").find("\nNot played: the meshes in objs. "),
            std::string::npos);
  EXPECT_EQ(scenes_of({"--only", "walk"}), std::vector<std::string>{"walk"});
}

TEST(Every_frame_experiment, refuses_a_scene_that_does_not_exist) {
  const Temporary_folder folder;
  folder.write("there.json", "{}");
  expect_error(run_program({"experiment", "every_frame", "--scenes", folder.path().string(), "--only", "none", "--out",
                            (folder.path() / "out").string()}),
               3, "there is no scene none; the scenes are there");
}

}  // namespace
}  // namespace lodestone::test
