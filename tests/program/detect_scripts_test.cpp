// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/run_program.h"
#include "support/mesh_samples.h"
#include "support/read_file.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// What scripts rely on.
class Detect_scripts : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder.write(name, bytes).string();
  }
  static Program_result detect(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "detect");
    arguments.insert(arguments.end(), {"--mode", "exact"});
    return run_program(arguments);
  }

  Temporary_folder folder;
  const std::string here = write("here.off", tetrahedron_off()), there = write("there.off", tetrahedron_off(9));
  const std::string again = write("again.off", tetrahedron_off());
};

TEST_F(Detect_scripts, the_exit_code_tells_whether_anything_collides_if_asked) {
  EXPECT_EQ(detect({here, again, "--exit-code"}).exit_code, 1);
  EXPECT_EQ(detect({here, there, "--exit-code"}).exit_code, 0);
  EXPECT_EQ(detect({here, again}).exit_code, 0);
  EXPECT_EQ(detect({here, "missing.off", "--exit-code"}).exit_code, 3);
}

TEST_F(Detect_scripts, quiet_prints_one_line) {
  EXPECT_EQ(detect({here, again, "--quiet"}).out,
            "meshes: 1 colliding pair, first in frame 0, last in frame 0 of 1 frame\n");
  EXPECT_EQ(detect({here, there, "--quiet"}).out, "meshes: 0 colliding pairs in 1 frame\n");
}

TEST_F(Detect_scripts, json_prints_the_summary) {
  const auto result = detect({here, again, there, "--json", "--out", (folder.path() / "out").string()});
  expect_success(result);
  Json printed = Json::parse(result.out), written = read_json(folder.path() / "out" / "summary.json");
  EXPECT_EQ(printed, written);
  EXPECT_EQ(printed["pairs"].at(0)["colliding_frames"], 1);
  EXPECT_EQ(detect({here, again, "--json", "--quiet"}).exit_code, 2);
}

TEST_F(Detect_scripts, the_first_and_last_colliding_frames_are_reported) {
  const std::vector<int> places{5, 1, 4, 0, 1, 7};
  for (std::size_t frame = 0; frame < places.size(); ++frame)
    write(fmt::format("m{}.off", frame), tetrahedron_off(places[frame]));
  const auto sequence = (folder.path() / "m#.off").string();
  const auto summary = Json::parse(detect({here, sequence, "--json"}).out)["pairs"].at(0);
  EXPECT_EQ(summary["colliding_frames"], 3);
  EXPECT_EQ(summary["first_colliding_frame"], 1);
  EXPECT_EQ(summary["last_colliding_frame"], 4);
  const auto table = detect({here, sequence}).out;
  EXPECT_NE(table.find("| first | last |"), std::string::npos) << table;
  EXPECT_NE(table.find("|         3 |     1 |    4 |"), std::string::npos) << table;
}

TEST_F(Detect_scripts, a_pair_that_never_collides_has_no_first_frame) {
  const auto summary =
      Json::parse(detect({here, write("near.off", "OFF\n3 1 0\n.9 .9 0\n.9 .9 1\n1 .9 .9\n3 0 1 2\n"), "--json"}).out);
  const Json& pair = summary["pairs"].at(0);
  EXPECT_EQ(pair["colliding_frames"], 0);
  EXPECT_TRUE(pair["first_colliding_frame"].is_null());
  EXPECT_TRUE(pair["last_colliding_frame"].is_null());
}

TEST_F(Detect_scripts, the_table_has_twenty_rows_unless_all_are_asked_for) {
  std::vector<std::string> same(8, here);  // 28 pairs
  const auto rows = [](const std::string& table) { return std::ranges::count(table, '|') / 7 - 2; };
  const auto cut = detect(same).out;
  EXPECT_EQ(rows(cut), 20) << cut;
  EXPECT_NE(cut.find("8 more pairs are omitted: --all-rows"), std::string::npos) << cut;
  same.emplace_back("--all-rows");
  const auto full = detect(same).out;
  EXPECT_EQ(rows(full), 28) << full;
  EXPECT_EQ(full.find("--all-rows"), std::string::npos);
  for (const auto* without_table : {"--quiet", "--json"}) {
    auto ignored = same;
    ignored.emplace_back(without_table);
    expect_error(detect(ignored), 2, "--all-rows");
  }
}

TEST_F(Detect_scripts, a_sentence_tells_that_the_table_leaves_out_pairs_that_never_came_near) {
  const std::string sentence = "Pairs that never came near each other are omitted";
  const auto none = detect({here, there}).out;
  EXPECT_EQ(none.find('|'), std::string::npos) << none;
  EXPECT_NE(none.find("No collision: no two objects came near each other.\n"), std::string::npos) << none;
  const auto one_of_three = detect({here, again, there}).out;
  EXPECT_NE(one_of_three.find("| here "), std::string::npos) << one_of_three;
  EXPECT_NE(one_of_three.find(sentence + ".\n"), std::string::npos) << one_of_three;
  const auto all = detect({here, again}).out;
  EXPECT_EQ(all.find("omitted"), std::string::npos) << all;
  const auto five = detect({here, again, there, there, there}).out;
  EXPECT_NE(five.find("Pairs of which nothing was found are omitted.\n"), std::string::npos) << five;
  const auto all_of_five = detect({here, again, again, again, again}).out;
  EXPECT_EQ(all_of_five.find("omitted"), std::string::npos) << all_of_five;
}

TEST_F(Detect_scripts, after_two_dashes_there_are_only_files) {
  const auto before = std::filesystem::current_path();
  std::filesystem::copy_file(there, folder.path() / "-there.off");
  std::filesystem::current_path(folder.path());
  const auto first = run_program({"detect", "--quiet", "--", here, "-there.off"});
  const auto later = run_program({"detect", here, "--quiet", "--", "-there.off"});
  const auto no_option = run_program({"detect", here, "--", "--quiet"});
  std::filesystem::current_path(before);
  for (const auto& result : {first, later}) {
    expect_success(result);
    EXPECT_TRUE(result.out.starts_with("meshes: 0 colliding")) << result.out;
  }
  EXPECT_NE(no_option.err.find("--quiet: there is no such file"), std::string::npos) << no_option.err;
}

TEST_F(Detect_scripts, a_mesh_may_come_from_the_standard_input) {
  const Program_options from_here{.standard_input = here};
  const auto run = [&](std::vector<std::string> arguments) { return run_program(arguments, from_here); };
  const auto result = run({"detect", "-", again, "--format", "off", "--quiet"});
  expect_success(result);
  EXPECT_TRUE(result.out.starts_with("meshes: 1 colliding")) << result.out;
  EXPECT_EQ(Json::parse(run({"info", "-", "--format", "off", "--json"}).out)["objects"].at(0)["vertices"], 4);
  const auto obj = (folder.path() / "out.obj").string();
  EXPECT_EQ(Json::parse(run({"detect", "-", again, "--format", "off", "--json"}).out)["objects"][0]["files"],
            Json({"-"}));
  expect_success(run({"convert", "-", obj, "--format", "off", "--quiet"}));
  expect_success(run({"partition", "-", "--format", "off", "--regions", "2", "--quiet"}));
  expect_error(run({"detect", "-", again}), 2, "--format");
  expect_error(run({"detect", "-", "-", "--format", "off"}), 2, "only one");
  expect_error(run({"detect", here, again, "--format", "off"}), 2, "--format");
  expect_error(run({"info", "-", "--format", "obj"}), 3, "lodestone: standard input:1:");
}

TEST_F(Detect_scripts, the_statistics_of_a_partition_have_the_region_of_each_vertex) {
  const auto json = (folder.path() / "p.json").string();
  const auto mesh = write("extra.off", "OFF\n5 2 0\n0 0 0\n5 5 5\n1 0 0\n1 1 0\n0 1 0\n3 0 2 3\n3 0 3 4\n");
  expect_success(run_program({"partition", mesh, "--regions", "2", "--json", json, "--quiet"}));
  const Json statistics = read_json(json);
  const Json& labels = statistics["labels"];
  ASSERT_EQ(labels.size(), 5U);
  EXPECT_TRUE(labels[1].is_null()) << "no face uses the vertex";
  std::vector<std::size_t> sizes(2);
  for (const std::size_t v : {0, 2, 3, 4}) ++sizes.at(labels[v].get<std::size_t>());
  EXPECT_EQ(Json(sizes), statistics["region_sizes"]);
}

TEST_F(Detect_scripts, a_partition_replaces_neither_its_mesh_nor_another_result_nor_a_pipe) {
  const std::string text = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const auto mesh = write("kept.off", text);
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  expect_error(run_program({"partition", mesh, "--regions", "1", "--json", path("./x/../kept.off")}), 2,
               "never overwritten");
  EXPECT_EQ(read_bytes(mesh), text);
  expect_error(run_program({"partition", mesh, "--regions", "1", "--out", path("a.ply"), "--json", path("./a.ply")}), 2,
               "cannot be the same file");
  EXPECT_FALSE(std::filesystem::exists(path("a.ply")));
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  expect_error(run_program({"partition", mesh, "--regions", "1", "--json", path("pipe")}), 4, "no regular file");
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
}

}  // namespace
}  // namespace lodestone::test
