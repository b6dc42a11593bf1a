// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <utility>

namespace lodestone::test {

Command_line::Command_line(const std::vector<std::string>& arguments, const std::string& program) : words_{program} {
  words_.insert(words_.end(), arguments.begin(), arguments.end());
  pointers_.reserve(words_.size() + 1);
  for (auto& word : words_) pointers_.push_back(word.data());
  pointers_.push_back(nullptr);
}

Running_program::Running_program(const std::vector<std::string>& arguments, const Program_options& options)
    : deadline_(std::chrono::steady_clock::now() + options.limit) {
  Command_line command(arguments, options.program);

  std::array<int, 2> out{}, err{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe can be made");
  process_ = ::fork();
  if (process_ == 0) {
    const int target =
        options.standard_output.empty() ? out[1] : ::open(options.standard_output.c_str(), O_WRONLY | O_CREAT, 0666);
    ::dup2(target, STDOUT_FILENO);
    ::dup2(err[1], STDERR_FILENO);
    if (!options.standard_input.empty()) ::dup2(::open(options.standard_input.c_str(), O_RDONLY), STDIN_FILENO);
    const rlimit size{options.largest_file, options.largest_file};
    if (options.largest_file != RLIM_INFINITY) ::setrlimit(RLIMIT_FSIZE, &size);
    ::execv(command.data()[0], command.data());
    ::_exit(127);
  }
  ::close(out[1]);
  ::close(err[1]);
  streams_ = {out[0], err[0]};
}

Running_program::~Running_program() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  for (const int stream : streams_) ::close(stream);
}

void Running_program::send(int signal) const { ::kill(process_, signal); }

Program_result Running_program::wait() {
  Program_result result;
  read_until_closed(result);
  if (result.timed_out) send(SIGKILL);
  int status = 0;
  ::waitpid(std::exchange(process_, 0), &status, 0);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

void Running_program::read_until_closed(Program_result& result) const {
  std::array<pollfd, 2> watched{{{streams_[0], POLLIN, 0}, {streams_[1], POLLIN, 0}}};
  const std::array<std::string*, 2> texts{&result.out, &result.err};
  while (watched[0].fd >= 0 || watched[1].fd >= 0) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - std::chrono::steady_clock::now());
    result.timed_out = left.count() <= 0;
    if (result.timed_out) return;
    ::poll(watched.data(), watched.size(), static_cast<int>(left.count()));
    for (std::size_t i = 0; i < watched.size(); ++i) {
      if (watched[i].revents == 0) continue;
      std::array<char, 4096> bytes{};
      const auto count = ::read(watched[i].fd, bytes.data(), bytes.size());
      if (count > 0)
        texts[i]->append(bytes.data(), static_cast<std::size_t>(count));
      else if (count == 0 || errno != EINTR)
        watched[i].fd = -1;
    }
  }
}

std::vector<std::string> detect_by_particles(std::vector<std::string> arguments) {
  if (std::ranges::find(arguments, "--mode") == arguments.end())
    arguments.insert(arguments.end(), {"--mode", "particles"});
  arguments.insert(arguments.begin(), "detect");
  return arguments;
}

Program_result run_program(const std::vector<std::string>& arguments, const Program_options& options) {
  return Running_program(arguments, options).wait();
}

std::set<std::string> content_of(const std::filesystem::path& folder) {
  std::set<std::string> names;
  if (is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names.insert(entry.path().filename().string());
  return names;
}

void expect_error(const Program_result& result, int exit_code, const std::string& part) {
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.starts_with("lodestone: ") && result.err.ends_with('\n')) << result.err;
  EXPECT_NE(result.err.find(part), std::string::npos) << "expected '" << part << "' in: " << result.err;
}

void expect_success(const Program_result& result) {
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
}

}  // namespace lodestone::test
