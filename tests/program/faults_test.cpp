// SPDX-License-Identifier: GPL-3.0-or-later
// Signals, full disks and files that change, for every command that writes files: nothing half-written is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "io/files/file_bytes.h"
#include "program/run_program.h"
#include "support/moving_mesh_files.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

class Faults : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }

  /// Two bodies that wobble, for so many frames.
  std::string scene(int frames) const {
    const std::string object = R"({"shape": {"icosphere": {"frequency": 6}}, "motion": {"deform": [
      {"wobble": {"amplitude": 0.1, "waves": 1, "period": 9}}]}, "name": )";
    const std::string text = R"({"frames": )" + std::to_string(frames) + R"(, "objects": [)";
    return folder.write("scene.json", text + object + R"("a"}, )" + object + R"("b"}]})").string();
  }

  /// Every command that writes files as it plays these frames.
  std::vector<Arguments> commands(int frames) const {
    const auto input = scene(frames), object = input + "#a";
    const auto last_of_glb = "0:" + std::to_string(std::min(frames, 2000) - 1);  // which has few frames
    std::vector<Arguments> all{{"detect", input, "--out", path("out")},
                               {"detect", input, "--out", path("out"), "--shard", "1/2"},
                               {"detect", input, "--paraview", path("paraview")},
                               {"convert", object, path("a.pc2"), "--quiet"},
                               {"convert", object, path("a.mdd"), "--quiet"},
                               {"convert", object, path("a.glb"), "--frames", last_of_glb, "--subdivide", "2"},
                               {"convert", object, path("meshes/a_####.ply")}};
    if (LODESTONE_HAS_VIEWER) all.push_back({"detect", input, "--html", path("a.html"), "--html-frames", "10"});
    return all;
  }

  /// All files of the folder with their sizes, but for what a shard keeps: that its work has begun.
  std::map<std::string, std::uintmax_t> files() const {
    std::map<std::string, std::uintmax_t> sizes;
    std::error_code gone;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path(), gone))
      if (entry.is_regular_file(gone) && entry.path().filename() != "manifest.json")
        sizes[entry.path().string()] = entry.file_size(gone);
    return sizes;
  }
  void wait_until_files_differ_from(const std::map<std::string, std::uintmax_t>& before) const {
    for (int i = 0; i < 4000 && files() == before; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_NE(files(), before) << "the run has not begun";
  }

  Temporary_folder folder;
};

std::string line_of(const Arguments& arguments) {
  std::string words;
  for (const auto& argument : arguments) words += argument + " ";
  return words;
}

/// A shell that runs the program as `$0`.
Program_result run_in_shell(const std::string& script, const Arguments& arguments = {}) {
  Arguments words{"-c", script, LODESTONE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_program(words, {.program = "/bin/bash"});
}

TEST_F(Faults, a_signal_in_the_middle_of_any_command_leaves_no_file_and_ends_with_130) {
  for (const auto& command : commands(1'000'000))
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      SCOPED_TRACE(line_of(command) + "signal " + std::to_string(signal));
      const auto before = files();
      Running_program program(command);
      wait_until_files_differ_from(before);
      program.send(signal);
      expect_error(program.wait(), 130, "interrupted");
      EXPECT_EQ(files(), before);
    }
}

TEST_F(Faults, a_terminal_that_closes_does_not_end_a_run_under_nohup) {
  const auto input = scene(1'000'000);
  const auto before = files();
  Running_program program(
      {"-c", "trap '' HUP; exec \"$0\" detect " + input + " --out " + path("out"), LODESTONE_PROGRAM},
      {.program = "/bin/bash"});
  wait_until_files_differ_from(before);
  program.send(SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_NE(files(), before);
  program.send(SIGTERM);
  expect_error(program.wait(), 130, "interrupted");
  EXPECT_EQ(files(), before);
}

TEST_F(Faults, a_full_disk_in_any_command_is_an_error_and_leaves_no_file) {
  for (const auto& command : commands(40)) {
    SCOPED_TRACE(line_of(command));
    const auto before = files();
    expect_success(run_in_shell("\"$0\" \"$@\" > /dev/null", command));
    std::uintmax_t largest = 0;
    for (const auto& [file, size] : files())
      if (!before.contains(file)) {
        largest = std::max(largest, size);
        fs::remove(file);
      }
    ASSERT_GT(largest, 500U);
    fs::remove_all(path("out"));
    for (const auto limit : {std::uintmax_t{0}, std::uintmax_t{200}, largest / 2}) {
      const auto result = run_program(command, {.largest_file = static_cast<rlim_t>(limit)});
      expect_error(result, 4, "cannot be written");
      EXPECT_EQ(files(), before) << limit;
    }
  }
}

TEST_F(Faults, a_disk_too_full_for_the_summary_leaves_no_frames) {
  const auto input = scene(2);
  expect_success(run_program({"detect", input, "--contacts", "yes_no", "--out", path("out")}));
  const auto frames = file_size(folder.path() / "out/frames.jsonl");
  const auto summary = file_size(folder.path() / "out/summary.json");  // which varies a little, as times do
  ASSERT_LT(frames + 100, summary);
  fs::remove_all(path("out"));
  expect_error(run_program({"detect", input, "--contacts", "yes_no", "--out", path("out")},
                           {.largest_file = static_cast<rlim_t>((frames + summary) / 2)}),
               4, "summary.json");
  EXPECT_FALSE(exists(folder.path() / "out"));
}

TEST_F(Faults, an_output_below_a_file_is_an_error_in_any_command) {
  const auto file = folder.write("file", "mine").string();
  const auto input = scene(3), object = input + "#a";
  for (const auto& command : std::vector<Arguments>{{"detect", input, "--out", file + "/out"},
                                                    {"detect", input, "--out", file + "/out", "--shard", "1/2"},
                                                    {"detect", input, "--paraview", file + "/paraview"},
                                                    {"convert", object, file + "/a.pc2"},
                                                    {"convert", object, file + "/a.glb"},
                                                    {"convert", object, file + "/a_##.obj"},
                                                    {"partition", path("file"), "--out", file + "/a.ply"}}) {
    SCOPED_TRACE(line_of(command));
    const auto result = run_program(command);
    EXPECT_TRUE(result.exit_code == 4 || (command.front() == "partition" && result.exit_code == 3)) << result.err;
    EXPECT_EQ(read_bytes(file), "mine");
  }
}

TEST_F(Faults, a_reader_that_leaves_ends_the_program_quietly_after_the_results_are_written) {
  const auto input = scene(400);
  const auto result =
      run_in_shell("\"$0\" detect " + input + " --all-rows --out " + path("out") + " | true; exit ${PIPESTATUS[0]}");
  EXPECT_EQ(result.exit_code, 141);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(content_of(folder.path() / "out"), (std::set<std::string>{"frames.jsonl", "summary.json"}));
}

TEST_F(Faults, a_reader_that_leaves_ends_help_quietly) {
  for (const std::string words : {"--help", "--help-all", "detect --help", "--version"}) {
    SCOPED_TRACE(words);
    const auto result = run_in_shell("exec 3> >(true); wait $!; \"$0\" " + words + " >&3; echo $? >&2");
    EXPECT_EQ(result.err, "141\n");
  }
}

TEST_F(Faults, a_standard_error_that_cannot_be_written_keeps_the_exit_code) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(run_in_shell("\"$0\" detect none.json 2> /dev/full").exit_code, 3);
  EXPECT_EQ(run_in_shell("\"$0\" detect none.json 2>&-").exit_code, 3);
}

TEST_F(Faults, a_file_that_is_cut_off_after_it_was_read_keeps_its_bytes) {
  const auto file = folder.write("a.bin", std::string(100'000, 'x'));
  const File_bytes bytes(file, std::filesystem::file_size(file));
  fs::resize_file(file, 10);
  EXPECT_EQ(bytes.view(), std::string(100'000, 'x'));
}

TEST_F(Faults, a_point_cache_that_is_cut_off_or_vanishes_during_a_run_is_an_error_and_leaves_no_file) {
  constexpr int frames = 400'000;
  for (const bool vanishes : {false, true}) {
    write_moving_tetrahedron(folder.path() / "a", frames);
    write_moving_tetrahedron(folder.path() / "b", 1, 1);
    const auto cache = folder.path() / "a.pc2";
    auto before = files();
    Running_program program({"detect", path("a.off") + "+" + cache.string(), path("b.off"), "--out", path("out")});
    wait_until_files_differ_from(before);
    if (vanishes)
      fs::remove(cache);
    else
      fs::resize_file(cache, 100);
    expect_error(program.wait(), 3, "a.pc2: frame ");
    EXPECT_FALSE(exists(folder.path() / "out"));
  }
}

TEST_F(Faults, a_file_of_a_sequence_that_changes_or_vanishes_during_a_run_is_an_error_and_leaves_no_file) {
  constexpr int frames = 3000;
  for (const std::string other : {"", "OFF\n1 1 0\n0 0 0\n3 0 0 0\n", "OFF\n"}) {
    for (int frame = 1000; frame < 1000 + frames; ++frame)
      folder.write("s_" + std::to_string(frame) + ".off", tetrahedron_off(frame % 3));
    folder.write("b.off", tetrahedron_off(1));
    const auto before = files();
    Running_program program({"detect", path("s_####.off"), path("b.off"), "--out", path("out")});
    wait_until_files_differ_from(before);
    const auto last = folder.path() / ("s_" + std::to_string(999 + frames) + ".off");
    if (other.empty())
      fs::remove(last);
    else
      folder.write(last.filename().string(), other);
    expect_error(program.wait(), 3, last.filename().string());
    EXPECT_FALSE(exists(folder.path() / "out"));
  }
}

}  // namespace
}  // namespace lodestone::test
