// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh on the standard input: how much of it is read, and what is left when it cannot be kept.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "program/run_program.h"
#include "program/standard_input.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Standard_input_of_the_program : public testing::Test {
 protected:
  Standard_input_of_the_program() {
    if (const char* given = std::getenv("TMPDIR")) before = given;
    create_directory(place);
    ::setenv("TMPDIR", place.c_str(), 1);
  }
  ~Standard_input_of_the_program() override {
    if (before)
      ::setenv("TMPDIR", before->c_str(), 1);
    else
      ::unsetenv("TMPDIR");
  }

  const std::vector<std::string> info{"info", "-", "--format", "obj"};
  Temporary_folder folder;
  const std::filesystem::path place = folder.path() / "temporary files";
  std::optional<std::string> before;  ///< what TMPDIR was; none: it was not set
};

/// Replaces the standard input of the test by a file.
class Replaced_input {
 public:
  explicit Replaced_input(const std::filesystem::path& file) : before_(::dup(STDIN_FILENO)) {
    const int opened = ::open(file.c_str(), O_RDONLY);
    ::dup2(opened, STDIN_FILENO);
    ::close(opened);
  }
  ~Replaced_input() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }
  Replaced_input(const Replaced_input&) = delete;
  Replaced_input& operator=(const Replaced_input&) = delete;

 private:
  int before_;
};

TEST_F(Standard_input_of_the_program, is_refused_beyond_the_limit_that_is_asked_for) {
  auto limited = info;
  limited.insert(limited.end(), {"--max-bytes", "20"});
  const auto file = folder.write("a.obj", square_obj);
  expect_success(run_program(info, {.standard_input = file}));
  expect_error(run_program(limited, {.standard_input = file}), 3,
               "the standard input has more than the 20 bytes that are allowed");
}

TEST_F(Standard_input_of_the_program, is_refused_beyond_the_limit_of_a_mesh_file) {
  const std::string text = tetrahedron_off();
  const auto file = folder.write("a.off", text);
  {
    const Replaced_input input(file);
    const Standard_input kept("off", text.size());
    EXPECT_EQ(read_bytes(kept.file()), text);
  }
  for (const std::filesystem::path& longer : {file, std::filesystem::path("/dev/zero")}) {
    const Replaced_input input(longer);
    EXPECT_THROW(Standard_input("off", text.size() - 1), Bad_mesh);
  }
  EXPECT_TRUE(content_of(place).empty());
}

TEST_F(Standard_input_of_the_program, that_cannot_be_kept_names_the_folder_for_temporary_files) {
  const auto result = run_program(info, {.largest_file = 1 << 20, .standard_input = "/dev/zero"});
  expect_error(result, 4, "the standard input cannot be kept: " + place.string());
  EXPECT_TRUE(content_of(place).empty());
  ::setenv("TMPDIR", (folder.path() / "nowhere").c_str(), 1);
  expect_error(run_program(info, {.standard_input = "/dev/zero"}), 4, (folder.path() / "nowhere").string() + ": ");
}

TEST_F(Standard_input_of_the_program, has_the_same_name_in_results_wherever_it_was_kept) {
  const auto file = folder.write("a.off", tetrahedron_off()).string();
  ::setenv("TMPDIR", (folder.path() / "." / place.filename()).c_str(), 1);
  const auto result = run_program({"detect", "-", file, "--format", "off", "--json"}, {.standard_input = file});
  expect_success(result);
  EXPECT_EQ(nlohmann::json::parse(result.out)["objects"][0]["files"], nlohmann::json({"-"}));
}

TEST_F(Standard_input_of_the_program, ends_at_a_signal_and_leaves_nothing) {
  const auto pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int writer = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);  // nobody writes: the program waits
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(signal);
    Running_program program(info, {.limit = std::chrono::seconds(20), .standard_input = pipe});
    for (int i = 0; i < 2000 && content_of(place).empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_FALSE(content_of(place).empty()) << "the program has not begun";
    program.send(signal);
    expect_error(program.wait(), 130, "interrupted");
    EXPECT_TRUE(content_of(place).empty());
  }
  ::close(writer);
}

}  // namespace
}  // namespace lodestone::test
