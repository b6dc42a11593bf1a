// SPDX-License-Identifier: GPL-3.0-or-later
// Long work in shards, as a user runs it: made in any order, stopped, damaged, merged.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/run_program.h"
#include "program/shards.h"
#include "support/gltf_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Words = std::vector<std::string>;

/// Two spheres that wobble and meet, and one that stays apart from frame 30 on.
constexpr std::string_view three_spheres = R"({"frames": 50, "objects": [
    {"name": "still", "shape": {"icosphere": {"frequency": 6}},
     "motion": {"deform": [{"wobble": {"amplitude": 0.05, "waves": 1, "period": 20, "phase": 0}}]}},
    {"name": "moving", "shape": {"icosphere": {"frequency": 5}}, "motion": {"deform": [{"travel":
      {"path": "smooth", "way_points": [{"frame": 0, "at": [3, 0, 0]}, {"frame": 20, "at": [1.6, 0, 0]},
                                        {"frame": 49, "at": [3, 1, 0]}]}}]}},
    {"name": "leaving", "shape": {"icosphere": {"frequency": 3}}, "motion": {"deform": [{"travel":
      {"path": "smooth", "way_points": [{"frame": 0, "at": [-1, 0, 0]}, {"frame": 30, "at": [-4, 0, 0]}]}}]}}]})";

struct Shards : ::testing::Test {
  Temporary_folder folder;
  const std::string scene = folder.write("scene.json", three_spheres).string();

  std::filesystem::path path(const std::string& name) const { return folder.path() / name; }
  Words detect(const std::string& out, const Words& more = {}) const {
    Words words{"detect", scene, "--out", path(out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  void make(const std::string& out, std::size_t index, std::size_t count, Words more = {}) const {
    more.insert(more.end(), {"--shard", std::to_string(index) + "/" + std::to_string(count)});
    expect_success(run_program(detect(out, more)));
  }
  std::string frames(const std::string& out) const { return read_bytes(path(out) / "frames.jsonl"); }
  Program_result merge(const std::string& out, const Words& more = {}) const {
    Words words{"merge", path(out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  nlohmann::json status(const std::string& out) const {
    const auto result = run_program({"status", path(out).string(), "--json"});
    expect_success(result);
    return nlohmann::json::parse(result.out);
  }
  /// Without what was measured.
  nlohmann::json summary(const std::string& out) const {
    auto json = read_json(path(out) / "summary.json");
    EXPECT_EQ(json.erase("median_microseconds"), 1U);
    EXPECT_EQ(json.erase("build_microseconds"), 1U);
    return json;
  }
};

TEST_F(Shards, of_a_scene_in_which_other_objects_meet_are_not_mixed) {
  make("a", 1, 2);
  std::string other(three_spheres);
  other.insert(other.rfind('}'), R"(, "ignore": [["still", "moving"]])");
  folder.write("scene.json", other);
  expect_error(run_program(detect("a", {"--shard", "2/2"})), 2, "these are shards of other work: inputs is ");
  folder.write("scene.json", three_spheres);
  make("a", 2, 2);
}

TEST_F(Shards, merged_are_the_bytes_of_one_run_whatever_is_asked_for) {
  const std::vector<Words> asked{
      {},
      {"--contacts", "all", "--points", "--normals", "--closest", "--truth"},
      {"--within", "0.05", "--containment", "--parting", "--patches"},
      {"--impacts"},
      {"--contacts", "yes_no", "--self", "--particles", "4"},
  };
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto whole = "whole" + std::to_string(i), parts = "parts" + std::to_string(i);
    const auto one = run_program(detect(whole, asked[i]));
    expect_success(one);
    for (const std::size_t index : {4, 1, 3, 2}) make(parts, index, 4, asked[i]);
    const auto merged = merge(parts);
    expect_success(merged);
    EXPECT_EQ(frames(parts), frames(whole));
    EXPECT_EQ(summary(parts), summary(whole));
    EXPECT_NE(merged.out.find("colliding"), std::string::npos);
  }
}

TEST_F(Shards, of_mode_certified_are_the_bytes_of_one_run_with_independent_frames) {
  expect_success(run_program(detect("plain", {"--mode", "certified", "--contacts", "all"})));
  expect_success(run_program(detect("whole", {"--mode", "certified", "--contacts", "all", "--independent-frames"})));
  for (const std::size_t index : {1, 2, 3}) make("parts", index, 3, {"--mode", "certified", "--contacts", "all"});
  expect_success(merge("parts"));
  EXPECT_EQ(frames("parts"), frames("whole"));
  auto plain = read_json_lines(path("plain") / "frames.jsonl"), parts = read_json_lines(path("parts") / "frames.jsonl");
  ASSERT_EQ(plain.size(), parts.size());
  for (std::size_t frame = 0; frame < plain.size(); ++frame) EXPECT_EQ(plain[frame]["pairs"], parts[frame]["pairs"]);
}

TEST_F(Shards, of_mode_certified_are_the_bytes_of_one_run_though_an_animation_has_ended) {
  /// A triangle below a node that is turned by 45 degrees, and rises.
  const auto rising = [&](const std::string& name, std::size_t frames, std::initializer_list<double> points) {
    Gltf_sample sample;
    const auto corners = sample.add_points(points), indices = sample.add_indices({0, 1, 2});
    sample.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", corners}}}, {"indices", indices}}}}}};
    sample.json["nodes"] = {
        {{"mesh", 0}, {"rotation", {0, 0, std::sin(std::acos(-1) / 8), std::cos(std::acos(-1) / 8)}}}};
    sample.json["scenes"] = {{{"nodes", {0}}}};
    const double end = 0.1 * static_cast<double>(frames - 1);
    sample.animate(0, "translation", sample.add_numbers({0, 0.1, end}),
                   sample.add_points({0, 0, 0, 0, 0, 0.001, 0, 0, 0.001 + 0.01 * (end - 0.1)}));
    return folder.write(name, sample.glb()).string();
  };
  // The sliver lies along a diagonal, and turned along an axis. Its turned box reaches the second triangle, it does
  // not. The third triangle meets it, so the detector looks where it is.
  const Words inputs{rising("sliver.glb", 3, {-1, -1, 0, 1, 1, 0, 0, 0, 0.1}),
                     rising("beside.glb", 11, {0.6, -0.6, 0, 0.7, -0.7, 0, 0.7, -0.6, 0.05}),
                     rising("across.glb", 11, {0.3, 0.4, 0.02, 0.4, 0.3, 0.02, 0.4, 0.4, 0.05})};
  const auto play = [&](const std::string& out, const Words& more) {
    Words words{"detect", "--mode", "certified", "--contacts", "all", "--out", path(out).string()};
    words.insert(words.end(), inputs.begin(), inputs.end());
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(words).exit_code, 0);  // a note tells that one has ended
  };
  play("whole", {"--independent-frames"});
  for (const std::string index : {"1", "2", "3"}) play("parts", {"--shard", index + "/3"});
  EXPECT_EQ(merge("parts").exit_code, 0);
  EXPECT_EQ(frames("parts"), frames("whole"));
}

/// A strip of triangles, or the same faces with their vertices anywhere.
std::string strip_off(std::size_t faces, bool crumpled) {
  std::string text = "OFF\n" + std::to_string(faces + 2) + " " + std::to_string(faces) + " 0\n";
  for (std::size_t v = 0; v < faces + 2; ++v) {
    const std::size_t place = crumpled ? v * 7919 % (faces + 2) : v;
    text += std::to_string(place) + " " + std::to_string(v % 2) + " " + std::to_string(place % 3) + "\n";
  }
  for (std::size_t f = 0; f < faces; ++f)
    text += "3 " + std::to_string(f) + " " + std::to_string(f + 1) + " " + std::to_string(f + 2) + "\n";
  return text;
}

TEST_F(Shards, keep_trees_that_one_run_rebuilds_and_answer_alike) {
  for (std::size_t frame = 0; frame < 8; ++frame)
    folder.write("strip_" + std::to_string(frame) + ".off", strip_off(400, frame >= 3));
  const auto strips = path("strip_*.off").string();
  const auto run = [&](const std::string& out, const Words& more) {
    Words words{"detect", strips, "shape:teapot", "--contacts", "all", "--self", "--out", path(out).string()};
    words.insert(words.end(), more.begin(), more.end());
    expect_success(run_program(words));
  };
  run("plain", {});
  run("independent", {"--independent-frames"});
  for (const std::string index : {"1/3", "2/3", "3/3"}) run("parts", {"--shard", index});
  expect_success(merge("parts"));
  EXPECT_EQ(frames("parts"), frames("independent"));
  std::size_t rebuilds = 0;
  const auto plain = read_json_lines(path("plain") / "frames.jsonl");
  const auto parts = read_json_lines(path("parts") / "frames.jsonl");
  ASSERT_EQ(plain.size(), 8U);
  for (std::size_t frame = 0; frame < plain.size(); ++frame) {
    EXPECT_EQ(plain[frame]["pairs"], parts[frame]["pairs"]);
    EXPECT_EQ(parts[frame]["statistics"]["rebuilds"], 0);
    rebuilds += plain[frame]["statistics"]["rebuilds"].get<std::size_t>();
  }
  EXPECT_GT(rebuilds, 0U);
}

TEST_F(Shards, of_particles_need_a_warm_up_and_are_the_same_each_time) {
  expect_error(run_program(detect("a", {"--mode", "particles", "--shard", "1/2"})), 2, "--warm-up W");
  expect_error(run_program(detect("a", {"--mode", "particles", "--warm-up", "3"})), 2, "--warm-up is for --shard");
  expect_error(run_program(detect("a", {"--warm-up", "3", "--shard", "1/2"})), 2, "--warm-up needs --mode particles");
  for (const std::string out : {"a", "b"}) {
    for (const std::size_t index : {1, 2}) make(out, index, 2, {"--mode", "particles", "--warm-up", "3"});
    expect_success(merge(out));
  }
  EXPECT_EQ(frames("a"), frames("b"));
  expect_success(run_program(detect("whole", {"--mode", "particles"})));
  // From the first frame on a shard with a long warm-up has walked the same way.
  for (const std::size_t index : {1, 2}) make("long", index, 2, {"--mode", "particles", "--warm-up", "50"});
  expect_success(merge("long"));
  EXPECT_EQ(frames("long"), frames("whole"));
}

TEST_F(Shards, that_were_made_for_a_long_table_can_be_merged_without_one) {
  for (const std::size_t index : {1, 2}) make("parts", index, 2, {"--all-rows"});
  const auto quiet = merge("parts", {"--quiet"});
  expect_success(quiet);
  EXPECT_EQ(quiet.out.find("leaving"), std::string::npos) << quiet.out;
  const auto long_table = merge("parts");
  expect_success(long_table);
  EXPECT_NE(long_table.out.find("leaving"), std::string::npos);
}

TEST_F(Shards, of_a_run_that_prints_json_print_nothing_else) {
  for (int time = 0; time < 2; ++time) {
    const auto made = run_program(detect("parts", {"--json", "--shard", "1/2"}));
    expect_success(made);
    EXPECT_EQ(made.out, "");
  }
}

TEST_F(Shards, more_than_there_are_frames_are_merged_too) {
  expect_success(run_program(detect("whole")));
  for (std::size_t index = 1; index <= 53; ++index) make("parts", index, 53);
  expect_success(merge("parts"));
  EXPECT_EQ(frames("parts"), frames("whole"));
  EXPECT_EQ(summary("parts"), summary("whole"));
}

TEST_F(Shards, that_are_done_are_not_made_again) {
  make("a", 2, 3);
  const auto file = path("a") / "shards" / "2-of-3.jsonl";
  const auto before = read_bytes(file);
  const auto again = run_program(detect("a", {"--shard", "2/3"}));
  expect_success(again);
  EXPECT_EQ(again.out, "shard 2 of 3 is done already\n");
  EXPECT_EQ(read_bytes(file), before);
}

TEST_F(Shards, of_other_work_are_refused_in_the_same_folder) {
  make("a", 1, 3);
  expect_error(run_program(detect("a", {"--shard", "2/4"})), 2, "shards is 3, not 4");
  expect_error(run_program(detect("a", {"--shard", "2/3", "--self"})), 2, "other work: command is");
  make("a", 2, 3, {"--threads", "2"});  // changes no result
  folder.write("scene.json", std::string(three_spheres).replace(three_spheres.find("1.6"), 3, "1.7"));
  make("a", 2, 3);  // the first and the last frame are the same: see docs/scale.md
  folder.write("scene.json", std::string(three_spheres).replace(three_spheres.find("[3, 1, 0]"), 9, "[3, 2, 0]"));
  expect_error(run_program(detect("a", {"--shard", "3/3"})), 2, "other work: inputs is");
  auto manifest = read_json(path("a") / "shards" / "manifest.json");
  manifest["revision"] = "another";
  std::ofstream(path("a") / "shards" / "manifest.json") << manifest;
  folder.write("scene.json", three_spheres);
  expect_error(run_program(detect("a", {"--shard", "3/3"})), 2, "other work: revision is");
  EXPECT_EQ(status("a")["broken"].size(), 2U);  // they are not of what the manifest says
}

TEST_F(Shards, that_are_missing_stop_a_merge_and_status_names_them) {
  for (const std::size_t index : {2, 3, 7}) make("a", index, 9);
  const auto refused = merge("a");
  expect_error(refused, 3, "6 of 9 shards missing: 1, 4-6, 8-9");
  EXPECT_EQ(content_of(path("a")), std::set<std::string>{"shards"});
  const auto json = status("a");
  EXPECT_EQ(json["shards"], 9);
  EXPECT_EQ(json["done"], 3);
  EXPECT_EQ(json["missing"], (std::vector<int>{1, 4, 5, 6, 8, 9}));
  EXPECT_EQ(json["last"]["shard"], 7);
  EXPECT_EQ(json["merged"], false);
  EXPECT_NE(json["next"].get<std::string>().find("lodestone submit --slurm --out "), std::string::npos);
  const auto text = run_program({"status", path("a").string()});
  expect_success(text);
  EXPECT_NE(text.out.find("3 of 9 shards done; missing: 1, 4-6, 8-9; not merged"), std::string::npos) << text.out;
}

TEST_F(Shards, that_are_damaged_are_found_and_made_again) {
  expect_success(run_program(detect("whole")));
  for (const std::size_t index : {1, 2, 3}) make("a", index, 3);
  const auto file = path("a") / "shards" / "2-of-3.jsonl";
  const auto whole = read_bytes(file);
  auto changed = whole;
  changed[changed.find("\"collides\":") + 12] ^= 1;
  auto record = whole;  // what it says of the objects goes to summary.json
  const auto vertices = record.rfind("\"vertices\":");
  ASSERT_NE(vertices, std::string::npos);
  record[vertices + 11] ^= 1;
  auto without_hash = whole;
  without_hash.replace(without_hash.rfind(",\"record_hash\""), std::string::npos, "}\n");
  const std::vector<std::string> damages{whole.substr(0, whole.size() / 2),
                                         whole.substr(0, whole.size() - 1),
                                         "",
                                         "\n",
                                         whole + "x\n",
                                         whole.substr(whole.find('\n') + 1),
                                         changed,
                                         record,
                                         without_hash};
  for (const auto& damage : damages) {
    folder.write("a/shards/2-of-3.jsonl", damage);
    expect_error(merge("a"), 3, "2-of-3.jsonl: is damaged");
    const auto json = status("a");
    ASSERT_EQ(json["broken"].size(), 1U);
    EXPECT_EQ(json["broken"][0]["shard"], 2);
    make("a", 2, 3);
    expect_success(merge("a"));
    EXPECT_EQ(frames("a"), frames("whole"));
    EXPECT_EQ(status("a")["merged"], true);
    EXPECT_EQ(status("a")["next"], "");
  }
}

TEST_F(Shards, that_are_interrupted_or_find_a_full_disk_leave_nothing_that_counts) {
  Program_options small;
  small.largest_file = 2000;
  const auto full = run_program(detect("a", {"--contacts", "all", "--shard", "1/2"}), small);
  EXPECT_EQ(full.exit_code, 4) << full.err;
  EXPECT_NE(full.err.find("1-of-2.jsonl: cannot be written"), std::string::npos) << full.err;
  EXPECT_EQ(content_of(path("a") / "shards"), std::set<std::string>{"manifest.json"});
  Running_program killed(detect("a", {"--contacts", "all", "--shard", "1/2"}));
  killed.send(SIGKILL);
  EXPECT_EQ(killed.wait().signal, SIGKILL);
  EXPECT_EQ(status("a")["done"], 0);
  folder.write("a/shards/.1-of-2.jsonl.17.0", "left by a killed process");
  for (const std::size_t index : {1, 2}) make("a", index, 2, {"--contacts", "all"});
  expect_success(merge("a"));
  EXPECT_EQ(content_of(path("a") / "shards"),
            (std::set<std::string>{"1-of-2.jsonl", "2-of-2.jsonl", "manifest.json", "merged"}));
}

TEST_F(Shards, answer_when_merged_as_one_run_would) {
  for (const std::size_t index : {1, 2}) make("a", index, 2, {"--exit-code", "--json"});
  const auto merged = merge("a");
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(merged.out)["frames"], 50);
  const auto quiet = merge("a", {"--quiet"});
  EXPECT_EQ(quiet.exit_code, 1);
}

TEST_F(Shards, refuse_options_that_need_all_frames) {
  expect_error(run_program({"detect", scene, "--shard", "1/2"}), 2, "--shard needs --out");
  expect_error(run_program(detect("a", {"--shard", "1/2", "--html", path("a.html").string()})), 2, "--html");
  expect_error(run_program(detect("a", {"--shard", "1/2", "--paraview", path("p").string()})), 2, "ParaView");
  for (const std::string shard : {"0/2", "3/2", "1", "a/b", "1/2/3", "1/", "-1/2", "1/100001"})
    expect_error(run_program(detect("a", {"--shard", shard})), 2, "--shard: expected I/N");
  EXPECT_FALSE(exists(path("a")));
}

TEST(Words_of_work, are_the_same_where_files_stand_after_two_dashes) {
  const Words expected{"detect", "./-a.off", "b.off", "./--quiet"};
  EXPECT_EQ(words_of_work({"detect", "--out", "o", "--shard", "1/2", "--", "-a.off", "b.off", "--quiet"}), expected);
  EXPECT_EQ(words_of_work({"detect", "--quiet", "./-a.off", "b.off", "./--quiet", "--threads=3"}), expected);
  EXPECT_EQ(words_of_work({"detect", "--", "-"}), (Words{"detect", "-"}));
}

TEST_F(Shards, that_are_lost_after_the_merge_are_told) {
  make("parts", 1, 2), make("parts", 2, 2);
  expect_success(merge("parts"));
  std::filesystem::remove(path("parts") / "shards" / "2-of-2.jsonl");
  const auto told = run_program({"status", path("parts").string()});
  EXPECT_NE(told.out.find("1 of 2 shards done; missing: 2; merged before these were lost"), std::string::npos)
      << told.out;
}

TEST_F(Shards, whose_results_are_lost_or_replaced_count_as_not_merged) {
  make("parts", 1, 2), make("parts", 2, 2);
  for (const char* file : {"frames.jsonl", "summary.json"}) {
    expect_success(merge("parts"));
    EXPECT_EQ(status("parts")["merged"], true);
    std::filesystem::remove(path("parts") / file);
    EXPECT_EQ(status("parts")["merged"], false) << file;
    EXPECT_NE(status("parts")["next"].get<std::string>().find("lodestone merge "), std::string::npos);
  }
  expect_success(merge("parts"));
  expect_success(run_program(detect("parts", {"--self"})));  // other work, in one run
  EXPECT_EQ(status("parts")["merged"], false);
}

TEST_F(Shards, merged_by_another_revision_tell_which_one_has_made_them) {
  for (const std::size_t index : {1, 2}) make("parts", index, 2);
  const auto manifest_file = path("parts") / "shards" / "manifest.json";
  auto manifest = read_json(manifest_file);
  manifest["revision"] = "0123456789ab";
  std::vector<std::vector<std::string>> lines(2);
  const Shard_folder made(path("parts"));
  std::vector<nlohmann::ordered_json> records;
  for (const std::size_t index : {1, 2})
    records.push_back(made.read(index, [&](std::string_view line) { lines[index - 1].emplace_back(line); }));
  std::ofstream(manifest_file) << manifest;
  const Shard_folder of_another(path("parts"));
  for (const std::size_t index : {1, 2}) {
    Shard_writer shard(of_another, index);
    for (const auto& line : lines[index - 1]) shard.add(line);
    shard.commit({{"objects", records[index - 1]["objects"]}});
  }
  expect_success(merge("parts"));
  EXPECT_EQ(read_json(path("parts") / "summary.json")["revision"], "0123456789ab");
}

TEST_F(Shards, that_another_process_has_made_meanwhile_need_not_be_renamed) {
  make("parts", 1, 2);
  const Shard_folder folder_of_shards(path("parts"));
  std::vector<std::string> lines;
  const auto record = folder_of_shards.read(1, [&](std::string_view line) { lines.emplace_back(line); });
  for (const bool is_made : {true, false}) {
    if (!is_made) std::filesystem::remove(folder_of_shards.file(1));
    Shard_writer late(folder_of_shards, 1);
    for (const auto& line : lines) late.add(line);
    for (const auto& entry : std::filesystem::directory_iterator(path("parts") / "shards"))
      if (entry.path().filename().string().starts_with('.')) std::filesystem::remove(entry.path());  // as a merge does
    if (is_made)
      EXPECT_NO_THROW(late.commit());
    else
      EXPECT_THROW(late.commit(), Bad_output);
  }
}

TEST_F(Shards, of_other_work_that_was_begun_at_the_same_moment_are_not_kept) {
  make("parts", 1, 2);
  const Shard_folder first(path("parts"));
  Shard_writer shard(first, 2);
  auto manifest = read_json(path("parts") / "shards" / "manifest.json");
  manifest["pieces"] = 17;
  std::ofstream(path("parts") / "shards" / "manifest.json") << manifest;
  EXPECT_THROW(shard.commit(), Bad_shard);
  EXPECT_FALSE(exists(first.file(2)));
}

TEST_F(Shards, that_cannot_be_read_are_told_from_missing_ones) {
  make("parts", 1, 1);
  EXPECT_EQ(run_program({"merge", ""}).exit_code, 2);
  EXPECT_EQ(run_program({"status", ""}).exit_code, 2);
  const auto manifest = path("parts") / "shards" / "manifest.json", shard = path("parts") / "shards" / "1-of-1.jsonl";
  for (const auto& [file, told] : {std::pair(shard, "1-of-1.jsonl"), std::pair(manifest, "manifest.json")}) {
    std::filesystem::permissions(file, std::filesystem::perms::none);
    if (std::ifstream(file)) GTEST_SKIP() << "root may read everything";
    expect_error(merge("parts"), 3, std::string(told) + ": cannot be read");
    std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  }
}

TEST_F(Shards, of_relative_inputs_are_found_again_from_elsewhere) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const auto made = run_program({"detect", "scene.json", "--out", "parts", "--shard", "1/2"});
  const auto here = run_program({"status", "parts"});
  std::filesystem::current_path(before);
  expect_success(made);
  EXPECT_NE(here.out.find("next: lodestone submit --slurm --out parts -- detect scene.json\n"), std::string::npos)
      << here.out;
  const auto elsewhere = run_program({"status", path("parts").string()});
  const std::string way = "cd " + folder.path().string() + " && lodestone ";
  EXPECT_NE(elsewhere.out.find("next: " + way + "submit"), std::string::npos) << elsewhere.out;
  EXPECT_NE(elsewhere.out.find("shards I: " + way + "detect scene.json --out " + path("parts").string()),
            std::string::npos)
      << elsewhere.out;
}

TEST_F(Shards, of_files_whose_names_are_not_utf8_are_refused_and_the_word_is_told) {
  const auto file = folder.write("\xff.json", three_spheres).string();
  const Words words{"detect", file, "--out", path("parts").string(), "--shard", "1/1"};
  expect_error(run_program(words), 2, "a word of the command line is not UTF-8, which shards need: ");
  EXPECT_FALSE(exists(path("parts")));
}

TEST_F(Shards, with_distances_beyond_the_largest_number_are_merged) {
  const auto mesh = [](const char* x) { return fmt::format("OFF\n3 1 0\n{0} 0 0\n{0} 1 0\n{0} 0 1\n3 0 1 2\n", x); };
  const auto a = folder.write("a.off", mesh("-1.5e308")).string(), b = folder.write("b.off", mesh("1.5e308")).string();
  expect_success(run_program({"detect", a, b, "--closest", "--out", path("parts").string(), "--shard", "1/1"}));
  expect_success(merge("parts"));
  expect_success(run_program({"detect", a, b, "--closest", "--out", path("whole").string()}));
  EXPECT_EQ(frames("parts"), frames("whole"));
}

TEST_F(Shards, of_no_folder_are_refused) {
  expect_error(run_program({"status", path("none").string()}), 3, "the folder has no shards");
  expect_error(run_program({"merge", path("none").string()}), 3, "the folder has no shards");
  create_directories(path("a") / "shards");
  folder.write("a/shards/manifest.json", R"({"command": ["convert"], "shards": 0, "pieces": 1})");
  expect_error(run_program({"status", path("a").string()}), 3, "is no manifest of shards");
  for (const char* lacking : {R"("folder": "/")", R"("revision": "")"}) {
    folder.write("a/shards/manifest.json",
                 std::string(R"({"command": ["detect"], "shards": 1, "pieces": 1, )") + lacking + "}");
    expect_error(run_program({"status", path("a").string()}), 3, "is no manifest of shards");
    expect_error(run_program({"merge", path("a").string()}), 3, "is no manifest of shards");
  }
  const std::string deep = std::string(300'000, '[') + std::string(300'000, ']');
  folder.write(
      "a/shards/manifest.json",
      R"({"command": ["detect"], "shards": 1, "pieces": 1, "folder": "/", "revision": "", "inputs": )" + deep + "}");
  EXPECT_EQ(run_program({"status", path("a").string()}).exit_code, 0);
  folder.write("a/shards/manifest.json",
               R"({"command": ["convert"], "shards": 1, "pieces": 1, "folder": "/", "revision": ""})");
  expect_error(run_program({"merge", path("a").string()}), 3, "neither detect nor an experiment");
}

TEST(Shard, parts_hold_each_piece_once) {
  for (const std::size_t pieces : {0, 1, 7, 24})
    for (const std::size_t count : {1, 3, 8}) {
      std::vector<std::size_t> in_order, of_all;
      for (std::size_t index = 1; index <= count; ++index) {
        for (const auto piece : Shard{index, count}.neighbours(pieces)) in_order.push_back(piece);
        for (const auto piece : Shard{index, count}.scattered(pieces)) of_all.push_back(piece);
      }
      std::ranges::sort(of_all);
      std::vector<std::size_t> expected(pieces);
      std::iota(expected.begin(), expected.end(), std::size_t{0});
      EXPECT_EQ(in_order, expected);
      EXPECT_EQ(of_all, expected);
    }
}

TEST(Shard, words_of_work_leave_out_what_changes_no_result) {
  EXPECT_EQ(words_of_work({"detect", "a b", "--out", "x", "--shard=1/2", "--quiet", "--threads", "2", "--self"}),
            (Words{"detect", "a b", "--self"}));
  EXPECT_EQ(ranges_of({1, 2, 3, 5, 8, 9}), "1-3, 5, 8-9");
  EXPECT_EQ(ranges_of({4}, ","), "4");
}

}  // namespace
}  // namespace lodestone::test
