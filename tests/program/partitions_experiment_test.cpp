// SPDX-License-Identifier: GPL-3.0-or-later
// The sweep of `experiment partitions` as a user runs it: stopped, continued, in parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
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

struct Partitions_experiment : ::testing::Test {
  Temporary_folder folder;

  /// The runs of one coarse mesh and one strategy: 25.
  std::vector<std::string> command(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{
        "experiment", "partitions", "--only", "cloth_coarse,lbg_position", "--out", (folder.path() / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::filesystem::path rows(const std::string& out) const { return folder.path() / out / "rows.jsonl"; }

  std::filesystem::path shard(const std::string& name) const { return folder.path() / "parts" / "shards" / name; }
  Program_result merge() const { return run_program({"merge", (folder.path() / "parts").string()}); }

  /// By id, without the fields that differ between two equal runs.
  std::map<std::string, nlohmann::json> results(const std::string& out) const {
    std::map<std::string, nlohmann::json> by_id;
    for (auto row : read_json_lines(rows(out))) {
      for (const char* key :
           {"seconds", "lbg_seconds", "peak_kib", "frame_us", "lbg_frame_us", "mean_frame_us", "lbg_mean_frame_us",
            "met_frame_us", "met_lbg_frame_us", "met_mean_frame_us", "met_lbg_mean_frame_us"})
        EXPECT_EQ(row.erase(key), 1U) << key;
      by_id.emplace(row["id"], row);
    }
    return by_id;
  }
};

TEST_F(Partitions_experiment, a_finished_sweep_does_nothing_more_and_reports_again) {
  const auto first = run_program(command("a", {"--jobs", "2"}));
  expect_success(first);
  EXPECT_NE(first.out.find("25 runs."), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("Island repair"), std::string::npos);
  const auto before = read_bytes(rows("a"));
  const auto again = run_program(command("a"));
  expect_success(again);
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(read_bytes(rows("a")), before);
  EXPECT_EQ(content_of(folder.path() / "a"),
            (std::set<std::string>{"figures.json", "manifest.json", "partitions.md", "rows.jsonl"}));
  const auto manifest = read_json(folder.path() / "a" / "manifest.json");
  for (const char* key : {"revision", "compiler", "processors", "regions", "seeds", "inputs"})
    EXPECT_TRUE(manifest.contains(key)) << key;
  EXPECT_EQ(manifest["inputs"].size(), 16U);
}

TEST_F(Partitions_experiment, killed_at_any_moment_it_continues_where_it_stopped) {
  std::size_t kept = 0;
  for (int kill = 0; kill < 4; ++kill) {
    Running_program program(command("a"));
    const auto wanted = kept + 3;
    for (int wait = 0; wait < 2000 && kept < wanted; ++wait) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (!exists(rows("a"))) continue;
      const auto text = read_bytes(rows("a"));
      kept = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    }
    program.send(SIGKILL);
    EXPECT_EQ(program.wait().signal, SIGKILL);
    const auto text = read_bytes(rows("a"));
    EXPECT_GE(static_cast<std::size_t>(std::ranges::count(text, '\n')), kept);
  }
  expect_success(run_program(command("a")));
  expect_success(run_program(command("whole")));
  EXPECT_EQ(results("a").size(), 25U);
  EXPECT_EQ(results("a"), results("whole"));
}

TEST_F(Partitions_experiment, an_interrupt_ends_it_with_a_message_and_keeps_the_finished_runs) {
  Running_program program(command("a"));
  for (int wait = 0; wait < 2000; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (exists(rows("a")) && !read_bytes(rows("a")).empty()) break;
  }
  program.send(SIGINT);
  const auto result = program.wait();
  EXPECT_NE(result.exit_code, 0);
  EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
  EXPECT_FALSE(read_json_lines(rows("a")).empty());
}

TEST_F(Partitions_experiment, shards_that_ran_separately_are_merged_to_the_rows_of_one_sweep) {
  const auto second = run_program(command("parts", {"--shard", "2/2", "--jobs", "2"}));
  expect_success(second);
  EXPECT_EQ(second.out, "shard 2 of 2: 12 of 25 pieces, in " + shard("2-of-2.jsonl").string() + "\n");
  EXPECT_EQ(content_of(folder.path() / "parts"), std::set<std::string>{"shards"});
  expect_error(merge(), 3, "1 of 2 shards missing: 1");
  expect_success(run_program(command("parts", {"--shard", "1/2"})));
  expect_success(merge());
  expect_success(run_program(command("whole")));
  EXPECT_EQ(results("parts"), results("whole"));
  std::vector<std::string> parts, whole;  // in the same order, too
  for (const auto& row : read_json_lines(rows("parts"))) parts.push_back(row["id"]);
  for (const auto& row : read_json_lines(rows("whole"))) whole.push_back(row["id"]);
  EXPECT_EQ(parts, whole);
  EXPECT_EQ(read_json(folder.path() / "parts" / "manifest.json"), read_json(folder.path() / "whole" / "manifest.json"));
  const auto files = content_of(folder.path() / "parts");
  EXPECT_TRUE(files.contains("figures.json") && files.contains("partitions.md"));
}

TEST_F(Partitions_experiment, shards_of_another_revision_are_merged_but_not_made) {
  expect_success(run_program(command("parts", {"--shard", "1/1"})));
  const Shard_folder made(folder.path() / "parts");
  auto manifest = made.manifest();
  manifest["revision"] = "0123456789ab";
  EXPECT_FALSE(manifest["inputs"].contains("revision")) << "a merge compares the inputs, but may be of any revision";
  std::vector<std::string> lines;
  const auto record = made.read(1, [&](std::string_view line) { lines.emplace_back(line); });
  std::ofstream(shard("manifest.json")) << manifest;
  const Shard_folder of_another(folder.path() / "parts");
  Shard_writer written(of_another, 1);
  for (const auto& line : lines) written.add(line);
  written.commit({{"processors", record["processors"]}});
  expect_error(run_program(command("parts", {"--shard", "1/1"})), 2, "0123456789ab");
  expect_success(merge());
  EXPECT_EQ(read_json(folder.path() / "parts" / "manifest.json")["revision"], "0123456789ab");
}

TEST_F(Partitions_experiment, a_shard_that_is_killed_keeps_its_finished_runs) {
  const auto begun = shard("1-of-1.begun.jsonl");
  Running_program program(command("parts", {"--shard", "1/1"}));
  std::size_t kept = 0;
  for (int wait = 0; wait < 2000 && kept < 4; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (exists(begun)) kept = static_cast<std::size_t>(std::ranges::count(read_bytes(begun), '\n'));
  }
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().signal, SIGKILL);
  auto before = read_json_lines(begun);
  ASSERT_GE(before.size(), 4U);
  EXPECT_EQ(before.front()["id"], "work");
  before.erase(before.begin());
  const auto status = run_program({"status", (folder.path() / "parts").string()});
  EXPECT_NE(status.out.find("missing: 1; of these with finished runs: 1;"), std::string::npos) << status.out;
  expect_success(run_program(command("parts", {"--shard", "1/1"})));
  EXPECT_FALSE(exists(begun));
  expect_success(merge());
  const auto after = read_json_lines(rows("parts"));
  ASSERT_EQ(after.size(), 25U);
  for (std::size_t run = 0; run < before.size(); ++run) EXPECT_EQ(after[run], before[run]);  // times too
}

TEST_F(Partitions_experiment, a_damaged_shard_is_not_merged) {
  for (const std::string index : {"1/2", "2/2"}) expect_success(run_program(command("parts", {"--shard", index})));
  auto text = read_bytes(shard("1-of-2.jsonl"));
  text[text.find("\"id\"") + 1] = 'x';
  folder.write("parts/shards/1-of-2.jsonl", text);
  expect_error(merge(), 3, "1-of-2.jsonl: is damaged");
  EXPECT_FALSE(exists(rows("parts")));
}

TEST_F(Partitions_experiment, a_merge_that_cannot_write_its_report_is_none) {
  expect_success(run_program(command("parts", {"--shard", "1/1"})));
  const auto report = folder.path() / "parts" / "partitions.md";
  std::filesystem::create_directories(report / "in the way");
  expect_error(merge(), 4, "partitions.md");
  const auto told = [&] { return run_program({"status", (folder.path() / "parts").string()}).out; };
  EXPECT_NE(told().find("; not merged"), std::string::npos) << told();
  std::filesystem::remove_all(report);
  expect_success(merge());
  EXPECT_NE(told().find("; merged"), std::string::npos) << told();
}

TEST_F(Partitions_experiment, a_journal_of_other_work_is_dropped) {
  expect_success(run_program(command("whole")));
  auto row = read_json_lines(rows("whole")).front();
  row["marked"] = true;
  const auto begun = shard("1-of-1.begun.jsonl");
  for (const auto* work : {R"({"id": "work", "hash": "other"})", R"({"id": "another run"})"}) {
    std::filesystem::create_directories(begun.parent_path());
    std::ofstream(begun) << work << '\n' << row << '\n';
    expect_success(run_program(command("parts", {"--shard", "1/1"})));
    expect_success(merge());
    const auto made = read_json_lines(rows("parts"));
    EXPECT_EQ(made.size(), 25U);
    for (const auto& each : made) EXPECT_FALSE(each.contains("marked"));
    std::filesystem::remove_all(folder.path() / "parts");
  }
}

TEST_F(Partitions_experiment, of_a_damaged_journal_the_rows_before_the_damage_are_kept) {
  expect_success(run_program(command("parts", {"--shard", "1/2"})));  // for the manifest
  const auto begun = shard("2-of-2.begun.jsonl");
  const std::string work = lodestone::Shard_folder(folder.path() / "parts").work();
  expect_success(run_program(command("whole")));
  std::vector<nlohmann::ordered_json> marked;
  for (auto row : read_json_lines(rows("whole"))) {
    row["marked"] = true;
    marked.push_back(row);
  }
  {
    std::ofstream journal(begun);
    journal << R"({"id": "work", "hash": ")" << work << "\"}\n";
    for (std::size_t i = 0; i < 20; ++i) journal << marked[i].dump() << '\n';
    journal << "dam\1age\n" << marked[20].dump() << '\n' << marked[21].dump() << '\n';
  }
  expect_success(run_program(command("parts", {"--shard", "2/2"})));
  expect_success(merge());
  std::set<std::string> kept;
  for (const auto& row : read_json_lines(rows("parts")))
    if (row.contains("marked")) kept.insert(row["id"]);
  EXPECT_FALSE(kept.empty());
  EXPECT_FALSE(kept.contains(marked[20]["id"]) || kept.contains(marked[21]["id"]));
}

TEST_F(Partitions_experiment, a_finished_sweep_is_reported_by_any_program) {
  const auto first = run_program(command("a"));
  expect_success(first);
  auto manifest = read_json(folder.path() / "a" / "manifest.json");
  manifest["revision"] = "another";
  std::ofstream(folder.path() / "a" / "manifest.json") << manifest;
  const auto again = run_program(command("a"));
  expect_success(again);
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(read_json(folder.path() / "a" / "manifest.json"), manifest);
}

TEST_F(Partitions_experiment, rows_of_another_program_are_not_mixed_in) {
  Running_program program(command("a"));
  for (int wait = 0; wait < 2000; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (exists(rows("a")) && !read_bytes(rows("a")).empty()) break;
  }
  program.send(SIGKILL);
  program.wait();
  auto manifest = read_json(folder.path() / "a" / "manifest.json");
  manifest["revision"] = "another";
  std::ofstream(folder.path() / "a" / "manifest.json") << manifest;
  expect_error(run_program(command("a")), 2, "another revision");
}

TEST_F(Partitions_experiment, labels_of_another_tool_take_part) {
  const auto meshes = folder.path() / "meshes";
  const auto written = run_program(
      {"experiment", "partitions", "--write-meshes", meshes.string(), "--out", (folder.path() / "none").string()});
  expect_success(written);
  EXPECT_EQ(content_of(meshes).size(), 8U);
  // The labels as `partition --json` gives them.
  const auto json = folder.path() / "p.json";
  expect_success(run_program({"partition", (meshes / "cloth_coarse.off").string(), "--strategy", "grid", "--regions",
                              "32", "--json", json.string(), "--quiet"}));
  const auto statistics = read_json(json);
  std::string labels;
  for (const auto& label : statistics["labels"]) labels += label.dump() + "\n";
  create_directories(folder.path() / "boxes");
  folder.write("boxes/cloth_coarse.labels", labels);
  const auto result =
      run_program({"experiment", "partitions", "--only", "boxes", "--strategy-file",
                   (folder.path() / "boxes" / "*.labels").string(), "--out", (folder.path() / "a").string()});
  expect_success(result);
  EXPECT_NE(result.out.find("5 runs."), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("| boxes    |      1 |"), std::string::npos) << result.out;
  folder.write("boxes/cloth_coarse.labels", "0\nx\n");
  expect_error(run_program({"experiment", "partitions", "--strategy-file", (folder.path() / "boxes").string(), "--out",
                            (folder.path() / "b").string()}),
               3, "cloth_coarse.labels:2: ");
  expect_error(run_program({"experiment", "modes", "--strategy-file", "x"}), 2, "--strategy-file");
}

TEST_F(Partitions_experiment, writing_the_meshes_leaves_the_report_of_an_earlier_run) {
  create_directories(folder.path() / "a");
  folder.write("a/partitions.md", "earlier");
  const auto meshes = (folder.path() / "meshes").string();
  const std::vector<std::string> words{
      "experiment", "partitions", "--out", (folder.path() / "a").string(), "--write-meshes", meshes};
  const auto written = run_program(words);
  expect_success(written);
  EXPECT_EQ(written.out, "The meshes are in " + meshes + ". Nothing was measured.\n");
  EXPECT_EQ(content_of(folder.path() / "a"), std::set<std::string>{"partitions.md"});
  EXPECT_EQ(read_bytes(folder.path() / "a" / "partitions.md"), "earlier");
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--html", "page.html"},
                                                                                      {"--only", "lbg"},
                                                                                      {"--shard", "1/2"},
                                                                                      {"--jobs", "2"},
                                                                                      {"--strategy-file", "x"}}) {
    auto more = words;
    more.insert(more.end(), {option, value});
    expect_error(run_program(more), 2, option);
  }
}

TEST_F(Partitions_experiment, bad_options_are_refused_in_one_line) {
  for (const std::string text : {"0/2", "3/2", "1", "a/b", "1/2/3", "1/", "-1/2"})
    expect_error(run_program(command("a", {"--shard", text})), 2, "--shard");
  expect_error(run_program(command("a", {"--jobs", "0"})), 2, "jobs");
  expect_error(run_program({"experiment", "partitions", "--only", "nothing"}), 2, "nothing");
  // A name may hold a comma: the only one that is not known here is the last.
  expect_error(run_program({"experiment", "partitions", "--only", "lbg, islands kept,lbg,other"}), 2,
               "variant 'other';");
}

TEST_F(Partitions_experiment, a_full_disk_is_an_error_and_a_second_sweep_in_the_same_folder_is_refused) {
  Program_options small;
  small.largest_file = 4096;
  const auto full = run_program(command("a"), small);
  EXPECT_NE(full.exit_code, 0);
  EXPECT_NE(full.err.find("cannot be written"), std::string::npos) << full.err;
  expect_success(run_program(command("a")));
  EXPECT_EQ(results("a").size(), 25U);

  Running_program program(command("b"));
  for (int wait = 0; wait < 2000 && !exists(rows("b")); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  expect_error(run_program(command("b")), 4, "another sweep");
  expect_success(program.wait());
}

}  // namespace
}  // namespace lodestone::test
