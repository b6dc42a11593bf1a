// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "program/run_program.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Program_output : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.off", tetrahedron_off());
    folder.write("b.off", tetrahedron_off(1));
  }
  std::string scene(int frames) const {
    return folder
        .write("scene.json", R"({"frames": )" + std::to_string(frames) + R"(, "objects": [
          {"name": "a", "mesh": "a.off"}, {"name": "b", "mesh": "b.off"}]})")
        .string();
  }
  /// Results of an earlier run, which a failing one must not touch.
  void leave_old_results() const {
    create_directory(out);
    folder.write("out/frames.jsonl", "old frames\n");
    folder.write("out/summary.json", "old summary\n");
  }
  void expect_old_results() const {
    EXPECT_EQ(content_of(out), (std::set<std::string>{"frames.jsonl", "summary.json"}));
    EXPECT_EQ(read_bytes(out / "frames.jsonl"), "old frames\n");
    EXPECT_EQ(read_bytes(out / "summary.json"), "old summary\n");
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Program_output, a_full_disk_is_an_error_and_leaves_nothing) {
  expect_error(
      run_program({"detect", "--mode", "particles", scene(20'000), "--out", out.string()}, {.largest_file = 500'000}),
      4, "frames.jsonl");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Program_output, a_disk_that_is_full_at_the_last_byte_is_an_error) {
  const auto input = scene(200);
  expect_success(run_program({"detect", "--mode", "particles", input, "--out", out.string()}));
  const auto size = file_size(out / "frames.jsonl");
  remove_all(out);
  expect_error(run_program({"detect", "--mode", "particles", input, "--out", out.string()}, {.largest_file = size - 1}),
               4, "frames.jsonl");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
  expect_success(run_program({"detect", "--mode", "particles", input, "--out", out.string()}, {.largest_file = size}));
}

TEST_F(Program_output, a_partition_on_a_full_disk_leaves_nothing) {
  const auto mesh = (folder.path() / "a.off").string();
  expect_error(run_program({"partition", mesh, "--out", (out / "a.ply").string(), "--json", (out / "a.json").string()},
                           {.largest_file = 100}),
               4, "a.json");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
  expect_error(run_program({"partition", mesh, "--json", (out / "a.json").string()}, {.largest_file = 100}), 4,
               "a.json");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Program_output, the_error_of_a_full_disk_names_the_file_that_was_asked_for) {
  const auto mesh = (folder.path() / "a.off").string();
  for (const auto* name : {"b.off", "b.ply", "b.gltf", "b.glb", "b.pc2", "b_#.obj"}) {
    SCOPED_TRACE(name);
    const auto target = name == std::string("b.gltf") ? "b.bin" : name == std::string("b_#.obj") ? "b_0.obj" : name;
    expect_error(
        run_program({"convert", mesh, (out / name).string(), "--subdivide", "2", "--quiet"}, {.largest_file = 100}), 4,
        (out / target).string() + ": cannot be written: ");
    EXPECT_EQ(content_of(out), std::set<std::string>{});
  }
  const auto in_pictures = run_program({"detect", scene(2), "--paraview", out.string()}, {.largest_file = 100});
  expect_error(in_pictures, 4, (out / "frames").string() + "/");
  EXPECT_EQ(in_pictures.err.find(".new."), std::string::npos) << in_pictures.err;
}

TEST_F(Program_output, old_results_survive_a_full_disk) {
  leave_old_results();
  expect_error(
      run_program({"detect", "--mode", "particles", scene(20'000), "--out", out.string()}, {.largest_file = 500'000}),
      4, "frames.jsonl");
  expect_old_results();
}

TEST_F(Program_output, old_results_survive_a_bad_input) {
  leave_old_results();
  folder.write("b.off", "OFF\n");
  expect_error(run_program({"detect", "--mode", "particles", scene(3), "--out", out.string()}), 3, "b.off");
  expect_old_results();
}

TEST_F(Program_output, old_results_are_replaced_by_a_run_that_succeeds) {
  leave_old_results();
  expect_success(run_program({"detect", "--mode", "particles", scene(3), "--out", out.string()}));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"frames.jsonl", "summary.json"}));
  EXPECT_EQ(read_json_lines(out / "frames.jsonl").size(), 3U);
  EXPECT_EQ(read_json(out / "summary.json")["frames"], 3);
}

TEST_F(Program_output, a_folder_that_is_a_file_is_an_error) {
  const auto file = folder.write("file", "mine");
  for (const auto& target : {file, file / "below"}) {
    expect_error(run_program({"detect", "--mode", "particles", scene(3), "--out", target.string()}), 4, "file");
    EXPECT_EQ(read_bytes(file), "mine");
  }
}

TEST_F(Program_output, a_result_does_not_replace_the_scene) {
  const auto input = scene(2);
  create_directory(out);
  rename(std::filesystem::path(input), out / "summary.json");
  for (const char* mesh : {"a.off", "b.off"}) rename(folder.path() / mesh, out / mesh);
  const auto before = read_bytes(out / "summary.json");
  expect_error(run_program({"detect", (out / "summary.json").string(), "--out", (out / ".." / "out").string()}), 2,
               "never overwritten");
  const auto object = [&](const char* name) { return (out / "summary.json#").string() + name; };
  expect_error(run_program({"detect", object("a"), object("b"), "--out", out.string()}), 2, "never overwritten");
  EXPECT_EQ(content_of(out), (std::set<std::string>{"a.off", "b.off", "summary.json"}));
  EXPECT_EQ(read_bytes(out / "summary.json"), before);
}

TEST_F(Program_output, a_folder_in_place_of_a_result_is_an_error) {
  for (const auto* name : {"frames.jsonl", "summary.json"}) {
    create_directories(out / name);
    expect_error(run_program({"detect", "--mode", "particles", scene(3), "--out", out.string()}), 4, name);
    EXPECT_EQ(content_of(out), std::set<std::string>{name});
    remove_all(out);
  }
}

TEST_F(Program_output, a_folder_that_cannot_be_created_is_an_error) {
  create_symlink("circle", folder.path() / "circle");
  for (const auto& target : {std::string("/proc/lodestone"), std::string("/dev/null"), std::string(300, 'x'),
                             std::string(5000, 'x'), (folder.path() / "circle").string()}) {
    SCOPED_TRACE(target);
    expect_error(run_program({"detect", "--mode", "particles", scene(3), "--out", target}), 4, target);
  }
}

TEST_F(Program_output, a_full_standard_output_is_an_error) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const std::vector<std::string>& help :
       {std::vector<std::string>{"--version"}, {"--help-all"}, {"detect", "--help"}, {"experiment", "--help"}})
    expect_error(run_program(help, {.standard_output = "/dev/full"}), 4, "standard output");
  expect_error(run_program({"detect", "--mode", "particles", scene(3)}, {.standard_output = "/dev/full"}), 4,
               "standard output");
  expect_error(run_program({"partition", (folder.path() / "a.off").string()}, {.standard_output = "/dev/full"}), 4,
               "standard output");
}

TEST_F(Program_output, a_signal_ends_the_run_and_leaves_no_partial_file) {
  const auto input = scene(1'000'000);
  for (const int signal : {SIGINT, SIGTERM})
    for (const bool old : {false, true}) {
      SCOPED_TRACE(signal);
      remove_all(out);
      if (old) leave_old_results();
      Running_program program({"detect", "--mode", "particles", input, "--truth", "--out", out.string()});
      const std::size_t before = old ? 2 : 0;
      for (int i = 0; i < 2000 && content_of(out).size() == before; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ASSERT_EQ(content_of(out).size(), before + 1) << "the run has not begun";
      program.send(signal);
      expect_error(program.wait(), 130, "interrupted");
      if (old)
        expect_old_results();
      else
        EXPECT_FALSE(exists(out)) << "the folder was made by the run";
    }
}

/// What a run holds while its results take their names.
class Held_lock {
 public:
  explicit Held_lock(const std::filesystem::path& folder) : descriptor_(::open(folder.c_str(), O_RDONLY | O_CLOEXEC)) {
    EXPECT_EQ(::flock(descriptor_, LOCK_EX | LOCK_NB), 0) << "somebody holds it";
  }
  Held_lock(const Held_lock&) = delete;
  Held_lock& operator=(const Held_lock&) = delete;
  ~Held_lock() { ::close(descriptor_); }

 private:
  int descriptor_;
};

TEST_F(Program_output, files_of_two_runs_into_one_folder_are_not_mixed) {
  leave_old_results();
  const std::vector<std::string> command{"detect", scene(3), "--out", out.string(), "--quiet"};
  const auto wait_until_written = [&] {  // two files of before, and two that wait for their names
    for (int i = 0; i < 2000 && content_of(out).size() < 4; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_EQ(content_of(out).size(), 4U);
  };
  std::optional<Held_lock> other(std::in_place, out);
  {
    Running_program program(command);
    wait_until_written();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(read_bytes(out / "frames.jsonl"), "old frames\n");
    EXPECT_EQ(read_bytes(out / "summary.json"), "old summary\n");
    other.reset();
    EXPECT_EQ(program.wait().exit_code, 0);
  }
  EXPECT_EQ(read_json_lines(out / "frames.jsonl").size(), 3U);
  EXPECT_EQ(read_json(out / "summary.json")["frames"], 3);
  leave_old_results();
  other.emplace(out);
  Running_program program(command);
  wait_until_written();
  program.send(SIGTERM);
  expect_error(program.wait(), 130, "interrupted");
  expect_old_results();
}

TEST_F(Program_output, a_lock_that_somebody_keeps_does_not_keep_results_from_being_written) {
  leave_old_results();
  const Held_lock kept(out);
  expect_success(run_program({"detect", scene(3), "--out", out.string()}));
  EXPECT_EQ(read_json(out / "summary.json")["frames"], 3);
}

TEST_F(Program_output, a_second_signal_ends_even_a_frame_that_takes_very_long) {
  const auto input = folder.write("long.json", R"({"objects": [
    {"name": "a", "shape": {"icosphere": {"frequency": 60}}, "particles": 30000},
    {"name": "b", "shape": {"icosphere": {"frequency": 60}}, "particles": 30000}]})");
  Running_program program({"detect", "--mode", "particles", input.string()}, {.limit = std::chrono::seconds(20)});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  program.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  program.send(SIGINT);
  const auto result = program.wait();
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, SIGINT);
}

}  // namespace
}  // namespace lodestone::test
