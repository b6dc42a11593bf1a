// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "support/read_file.h"

/// Starts the program as a user would, and inspects what it leaves behind.
namespace lodestone::test {

/// The program's name and arguments as `exec` wants them.
class Command_line {
 public:
  explicit Command_line(const std::vector<std::string>& arguments, const std::string& program = LODESTONE_PROGRAM);
  Command_line(const Command_line&) = delete;
  Command_line& operator=(const Command_line&) = delete;

  char** data() { return pointers_.data(); }

 private:
  std::vector<std::string> words_;
  std::vector<char*> pointers_;
};

/// How a run ended.
struct Program_result {
  int exit_code = -1;      ///< -1: killed by a signal
  int signal = 0;          ///< that ended it; 0: none
  bool timed_out = false;  ///< it was killed for taking too long
  std::string out, err;    ///< what it wrote to the standard output and to the standard error
};

struct Program_options {
  std::string program = LODESTONE_PROGRAM;
  std::chrono::seconds limit{60};       ///< a run that takes longer is killed
  rlim_t largest_file = RLIM_INFINITY;  ///< bytes; writing more fails as a full disk does
  std::string standard_output = {};     ///< file for the standard output; empty: captured
  std::string standard_input = {};      ///< file for the standard input; empty: that of the test
};

/// The program at work.
class Running_program {
 public:
  explicit Running_program(const std::vector<std::string>& arguments, const Program_options& options = {});
  Running_program(const Running_program&) = delete;
  Running_program& operator=(const Running_program&) = delete;
  ~Running_program();

  void send(int signal) const;
  Program_result wait();

 private:
  void read_until_closed(Program_result& result) const;

  std::chrono::steady_clock::time_point deadline_;
  pid_t process_ = 0;
  std::array<int, 2> streams_{};
};

/// `detect` with these inputs and options, and with `--mode particles` unless they name a mode.
std::vector<std::string> detect_by_particles(std::vector<std::string> arguments);

Program_result run_program(const std::vector<std::string>& arguments, const Program_options& options = {});

/// Names of all entries of a folder; empty if there is no such folder.
std::set<std::string> content_of(const std::filesystem::path& folder);

/// The run must have exited with this code, with no standard output and one line of standard error that contains
/// `part`.
void expect_error(const Program_result& result, int exit_code, const std::string& part);

void expect_success(const Program_result& result);

}  // namespace lodestone::test
