// SPDX-License-Identifier: GPL-3.0-or-later
// `lodestone submit` without a cluster: what the scripts say, and a stand-in for sbatch. scripts/integrations/slurm
// tests it with Slurm.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "program/run_program.h"
#include "program/shards.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

struct Submit : ::testing::Test {
  Temporary_folder folder;
  const std::string scene = folder
                                .write("a scene.json", R"({"frames": 12, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 4}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 3}}, "motion": {"deform": [{"travel": {"path": "linear",
        "way_points": [{"frame": 0, "at": [3, 0, 0]}, {"frame": 11, "at": [1.5, 0, 0]}]}}]}}]})")
                                .string();
  const std::filesystem::path out = folder.path() / "it's 100% out";

  /// Restores the PATH at the end of the test.
  struct Path {
    std::string before = std::getenv("PATH");
    void set(const std::string& path) const { ::setenv("PATH", path.c_str(), 1); }
    ~Path() { set(before); }
  } path;

  Program_result submit(const std::vector<std::string>& options, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"submit", "--slurm", "--out", out.string()};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), {"--", "detect", scene});
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  std::string script(const std::string& name) const { return read_bytes(out / "slurm" / name); }
  /// Runs a script as Slurm would for one task.
  static int run(const std::filesystem::path& script, int task) {
    const auto quoted = "\"" + script.string() + "\"";
    return std::system(("SLURM_ARRAY_TASK_ID=" + std::to_string(task) + " bash " + quoted + " > /dev/null").c_str());
  }
  void expect_line(const std::string& text, const std::string& line) const {
    EXPECT_NE(text.find("\n" + line + "\n"), std::string::npos) << line << " in\n" << text;
  }
};

TEST_F(Submit, writes_scripts_that_make_and_merge_the_shards) {
  const auto result = submit({"--shards", "5", "--dry-run", "--partition", "long", "--account", "physics"},
                             {"--contacts", "all", "--threads", "3"});
  expect_success(result);
  EXPECT_NE(result.out.find("pilot: shard 3/5"), std::string::npos) << result.out;
  const auto array = script("array.sh");
  expect_line(array, "#SBATCH --array=1-2,4-5");  // the pilot counts
  expect_line(array, "#SBATCH --partition=long");
  expect_line(array, "#SBATCH --account=physics");
  expect_line(array, "#SBATCH --nodes=1 --ntasks=1 --cpus-per-task=3");
  expect_line(array, "#SBATCH --time=1");
  expect_line(array, "#SBATCH --requeue");
  expect_line(array, "set -euo pipefail");
  expect_line(array, "#SBATCH --output=\"" + folder.path().string() + "/it's 100%% out/slurm/task-%a.log\"");
  for (const int task : {1, 2, 4}) EXPECT_EQ(run(out / "slurm" / "array.sh", task), 0);
  EXPECT_NE(run(out / "slurm" / "merge.sh", 0), 0);  // one is missing
  EXPECT_FALSE(exists(out / "frames.jsonl"));
  EXPECT_EQ(run(out / "slurm" / "array.sh", 5), 0);
  EXPECT_EQ(run(out / "slurm" / "merge.sh", 0), 0);
  const auto whole = folder.path() / "whole";
  expect_success(run_program({"detect", scene, "--contacts", "all", "--out", whole.string()}));
  EXPECT_EQ(read_bytes(out / "frames.jsonl"), read_bytes(whole / "frames.jsonl"));
  const auto done = submit({"--dry-run"}, {"--contacts", "all"});
  expect_success(done);
  EXPECT_NE(done.out.find("all shards are done; next: lodestone merge "), std::string::npos);
}

TEST_F(Submit, needs_no_pilot_if_time_and_memory_are_given) {
  const auto result = submit({"--shards", "5", "--tasks", "2", "--minutes", "7", "--megabytes", "300", "--dry-run"});
  expect_success(result);
  EXPECT_EQ(result.out.find("pilot"), std::string::npos);
  const auto array = script("array.sh");
  expect_line(array, "#SBATCH --array=1-2");
  expect_line(array, "#SBATCH --time=21");  // each task makes up to three shards
  expect_line(array, "#SBATCH --mem=300M");
  EXPECT_EQ(run(out / "slurm" / "array.sh", 2), 0);
  EXPECT_EQ(content_of(out / "shards"), (std::set<std::string>{"2-of-5.jsonl", "4-of-5.jsonl", "manifest.json"}));
}

TEST_F(Submit, a_shard_that_fails_does_not_keep_its_task_from_the_others) {
  expect_success(submit({"--shards", "5", "--tasks", "2", "--minutes", "7", "--megabytes", "300", "--dry-run"}));
  std::filesystem::create_directories(out / "shards" / "3-of-5.jsonl" / "in the way");
  EXPECT_NE(run(out / "slurm" / "array.sh", 1), 0);
  EXPECT_TRUE(exists(out / "shards" / "1-of-5.jsonl"));
  EXPECT_TRUE(exists(out / "shards" / "5-of-5.jsonl"));
  std::filesystem::remove_all(out / "shards" / "3-of-5.jsonl");
  EXPECT_EQ(run(out / "slurm" / "array.sh", 1), 0);
  EXPECT_TRUE(exists(out / "shards" / "3-of-5.jsonl"));
}

TEST_F(Submit, from_another_folder_has_its_tasks_run_where_the_shards_were_begun) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const auto begun = run_program({"detect", "a scene.json", "--out", "parts", "--shard", "1/2"});
  std::filesystem::current_path(before);
  expect_success(begun);
  const auto parts = folder.path() / "parts";
  expect_success(
      run_program({"submit", "--slurm", "--dry-run", "--out", parts.string(), "--", "detect", "a scene.json"}));
  EXPECT_EQ(run(parts / "slurm" / "array.sh", 2), 0);
  EXPECT_TRUE(exists(parts / "shards" / "2-of-2.jsonl"));
}

TEST_F(Submit, of_a_command_that_prints_json_or_a_long_table_is_not_quiet) {
  for (const std::string table : {"--json", "--all-rows"}) {
    std::filesystem::remove_all(out);
    expect_success(submit({"--shards", "2", "--dry-run"}, {table}));
    EXPECT_EQ(run(out / "slurm" / "array.sh", 2), 0) << table;
    EXPECT_EQ(run(out / "slurm" / "merge.sh", 0), 0) << table;
  }
}

TEST_F(Submit, makes_no_pilot_of_a_shard_without_frames) {
  const auto short_scene = folder.write("short.json", R"({"frames": 5, "objects": [
      {"name": "a", "shape": {"icosphere": {"frequency": 4}}}, {"name": "b", "shape": {"icosphere": {"frequency": 3}}}]})");
  const auto result = run_program({"submit", "--slurm", "--dry-run", "--shards", "16", "--out", out.string(), "--",
                                   "detect", short_scene.string()});
  expect_success(result);
  const auto last_pilot = result.out.rfind("pilot: shard ");
  ASSERT_NE(last_pilot, std::string::npos) << result.out;
  const auto index = std::stoul(result.out.substr(last_pilot + 13));
  EXPECT_FALSE(Shard({.index = index, .count = 16}).neighbours(5).empty()) << result.out;
}

TEST_F(Submit, gives_both_scripts_to_sbatch_and_submits_only_what_is_missing) {
  const auto words = folder.write("sbatch_words", "");
  const auto sbatch = folder.write("sbatch", "#!/bin/sh\necho \"$@\" >> '" + words.string() + "'\necho '17;cluster'\n");
  std::filesystem::permissions(sbatch, std::filesystem::perms::owner_all);
  path.set(folder.path().string() + ":" + path.before);
  const auto first = submit({"--shards", "3"});
  expect_success(first);
  EXPECT_NE(first.out.find("job 17: 2 shards; job 17: merge"), std::string::npos) << first.out;
  EXPECT_EQ(read_bytes(words), "--parsable " + (out / "slurm" / "array.sh").string() + "\n--parsable " +
                                   "--dependency=afterany:17 " + (out / "slurm" / "merge.sh").string() + "\n");
  expect_success(run_program({"detect", scene, "--out", out.string(), "--shard", "1/3"}));
  const auto second = submit({"--time-factor", "1000"});
  expect_success(second);
  EXPECT_EQ(second.out.find("pilot"), std::string::npos);
  expect_line(script("array.sh"), "#SBATCH --array=3");
  folder.write("sbatch", "#!/bin/sh\ncase \"$*\" in *dependency*) exit 1;; esac\necho 18\n");
  std::filesystem::permissions(sbatch, std::filesystem::perms::owner_all);
  const auto alone = submit({});
  EXPECT_EQ(alone.exit_code, 3);
  EXPECT_NE(alone.out.find("job 18: 1 shard, perhaps without its merge; then: sbatch --dependency=afterany:18 "),
            std::string::npos)
      << alone.out;
  folder.write("sbatch", "#!/bin/sh\nexit 1\n");
  std::filesystem::permissions(sbatch, std::filesystem::perms::owner_all);
  const auto failed = submit({});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_NE(failed.err.find("sbatch failed, with exit code 1"), std::string::npos) << failed.err;
}

TEST_F(Submit, says_what_is_wrong_in_one_line) {
  path.set("/nowhere");
  expect_error(submit({}), 2, "sbatch is not on the PATH");
  expect_error(submit({"--dry-run"}, {"--out", "x"}), 2, "--out belongs to submit");
  expect_error(submit({"--dry-run"}, {"--shard=1/2"}), 2, "--shard belongs to submit");
  expect_error(submit({"--dry-run", "--minutes", "1", "--megabytes", "9"}, {"--threads", "0"}), 2,
               "takes a whole node");
  expect_error(submit({"--dry-run"}, {"--threads", "0"}), 2, "--threads 0 takes a whole node");
  EXPECT_FALSE(exists(out / "shards")) << "a pilot that is of no use";
  expect_error(run_program({"submit", "--slurm", "--out", out.string(), "--dry-run", "--", "info", scene}), 2,
               "only detect and experiment");
  expect_error(run_program({"submit", "--out", out.string(), "--", "detect", scene}), 2, "--slurm is required");
  expect_success(submit({"--dry-run", "--shards", "2"}));
  expect_error(submit({"--dry-run"}, {"--self"}), 2, "shards of other work");
  auto manifest = read_json(out / "shards" / "manifest.json");
  manifest["revision"] = "another";
  std::ofstream(out / "shards" / "manifest.json") << manifest;
  expect_error(submit({"--dry-run"}), 2, "made by revision \"another\"");
}

TEST_F(Submit, of_a_command_that_fails_writes_no_scripts) {
  std::filesystem::remove(scene);
  const auto result = submit({"--dry-run"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("failed, with exit code 3"), std::string::npos) << result.err;
  EXPECT_FALSE(exists(out));
}

TEST_F(Submit, ends_with_the_exit_code_of_the_pilot) {
  EXPECT_EQ(submit({"--dry-run"}, {"--contacts", "some"}).exit_code, 2);
  const auto unwritable =
      run_program({"submit", "--slurm", "--dry-run", "--out", "/proc/lodestone", "--", "detect", scene});
  EXPECT_EQ(unwritable.exit_code, 4) << unwritable.err;
  EXPECT_FALSE(exists(out));
}

TEST_F(Submit, passes_a_signal_on_to_the_pilot_and_writes_no_scripts) {
  auto longer = nlohmann::json::parse(read_bytes(scene));
  longer["frames"] = 1'000'000;
  folder.write("a scene.json", longer.dump());
  for (const int signal : {SIGINT, SIGTERM}) {
    SCOPED_TRACE(signal);
    Running_program program(
        {"submit", "--slurm", "--dry-run", "--out", out.string(), "--shards", "2", "--", "detect", scene},
        {.limit = std::chrono::seconds(20)});
    const auto begun = [&] { return content_of(out / "shards").size() >= 2; };  // the manifest and a shard
    for (int i = 0; i < 2000 && !begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(begun()) << "the pilot has not begun";
    program.send(signal);
    const auto result = program.wait();
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_NE(result.err.find("lodestone: interrupted"), std::string::npos) << result.err;
    EXPECT_FALSE(exists(out / "slurm"));
    EXPECT_EQ(content_of(out / "shards"), (std::set<std::string>{"manifest.json"}));
  }
}

}  // namespace
}  // namespace lodestone::test
