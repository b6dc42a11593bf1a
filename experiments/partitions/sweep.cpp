// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/sweep.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <numeric>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

using Row = nlohmann::ordered_json;
using Execute = std::function<Row(std::size_t)>;

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// A run in a process of its own. It sends its row, or what went wrong, through a pipe.
class Child {
 public:
  Child(std::size_t run, const Execute& execute) : run_(run) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Bad_output(std::string("no pipe: ") + std::strerror(errno));
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a sweep that is killed leaves nothing running
      if (::getppid() != parent) ::_exit(1);
      ::close(ends[0]);
      write_all(ends[1], answer(run, execute));
      ::_exit(0);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
    if (process_ < 0) {
      ::close(pipe_);
      throw Bad_output(std::string("no process: ") + std::strerror(errno));
    }
  }
  Child(Child&& other) noexcept
      : run_(other.run_),
        process_(std::exchange(other.process_, 0)),
        pipe_(std::exchange(other.pipe_, -1)),
        text_(std::move(other.text_)) {}
  Child& operator=(Child&& other) noexcept {
    std::swap(run_, other.run_);
    std::swap(process_, other.process_);
    std::swap(pipe_, other.pipe_);
    std::swap(text_, other.text_);
    return *this;
  }
  ~Child() {
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
    }
    if (pipe_ >= 0) ::close(pipe_);
  }

  std::size_t run() const { return run_; }
  int pipe() const { return pipe_; }

  /// Takes what has come. @return whether the run has ended
  bool read() {
    std::array<char, 65536> bytes{};
    const auto count = ::read(pipe_, bytes.data(), bytes.size());
    if (count > 0) text_.append(bytes.data(), static_cast<std::size_t>(count));
    return count == 0 || (count < 0 && errno != EINTR);
  }

  /// @return the row, or {"failed": cause}
  Row result() {
    int status = 0;
    ::waitpid(std::exchange(process_, 0), &status, 0);
    if (WIFSIGNALED(status)) return {{"failed", fmt::format("ended by signal {}", WTERMSIG(status))}};
    Row row = Row::parse(text_, nullptr, false);
    return row.is_object() ? row : Row{{"failed", "it gave no row"}};
  }

 private:
  static std::string answer(std::size_t run, const Execute& execute) {
    try {
      return execute(run).dump();
    } catch (const std::exception& error) {
      return Row{{"failed", error.what()}}.dump(-1, ' ', false, Row::error_handler_t::replace);
    }
  }

  std::size_t run_;
  pid_t process_ = 0;
  int pipe_ = -1;
  std::string text_;
};

/// Waits for any of the children, at most a tenth of a second. @return those that have ended
std::vector<Child> ended(std::vector<Child>& children) {
  std::vector<pollfd> watched;
  for (const auto& child : children) watched.push_back({child.pipe(), POLLIN, 0});
  ::poll(watched.data(), watched.size(), 100);
  std::vector<Child> result, others;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const bool over = watched[i].revents != 0 && children[i].read();
    (over ? result : others).push_back(std::move(children[i]));
  }
  children = std::move(others);
  return result;
}

}  // namespace

std::vector<std::string> sweep(const std::vector<std::string>& ids, Row_file& rows, const Sweep_options& options,
                               const Execute& execute, const std::function<void(std::size_t, std::size_t)>& progress) {
  if (options.jobs == 0) throw Bad_argument("the number of jobs must be at least 1");
  const std::size_t all = ids.size();
  std::vector<std::size_t> waiting(all);
  std::iota(waiting.begin(), waiting.end(), std::size_t{0});
  std::erase_if(waiting, [&](std::size_t run) { return rows.has(ids[run]); });
  std::ranges::reverse(waiting);

  std::vector<std::string> failures;
  std::vector<Child> children;
  while (!waiting.empty() || !children.empty()) {
    progress(all - waiting.size() - children.size(), all);
    while (!waiting.empty() && children.size() < options.jobs) {
      children.emplace_back(waiting.back(), execute);
      waiting.pop_back();
    }
    for (auto& child : ended(children)) {
      const auto& id = ids[child.run()];
      Row result = child.result();
      if (result.contains("failed")) {
        failures.push_back(id + ": " + result["failed"].get<std::string>());
        continue;
      }
      Row row{{"id", id}};
      row.update(result);
      rows.add(row);
    }
  }
  progress(all, all);
  return failures;
}

}  // namespace lodestone
