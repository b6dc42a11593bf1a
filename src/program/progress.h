// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace lodestone {

/// Thrown to end a run at the user's request.
struct Interrupted {};

/// From now on SIGINT, SIGTERM and SIGHUP end the run at the next frame and leave no partial file, unless they were
/// ignored. A second signal ends it at once, and may leave a hidden temporary file behind. To write where nobody reads
/// is an error, not a signal.
void handle_interrupts();
/// @throws Interrupted  the user has asked to stop
void check_interrupt();

/// A progress bar on the terminal. Silent if the output is not a terminal, or if `quiet`.
class Progress_bar {
 public:
  Progress_bar(std::string label, bool quiet);
  ~Progress_bar();
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;

  /// Shows that `done` of `of` steps are done. Redraws at most ten times a second.
  /// @throws Interrupted
  void operator()(std::size_t done, std::size_t of);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  bool shown_;
  bool drawn_ = false;
  /// The first call. What was done before it, perhaps by another process, says nothing about the time.
  struct Begin {
    std::size_t done;
    Clock::time_point at;
  };
  std::optional<Begin> begun_;
  Clock::time_point last_drawn_;
};

}  // namespace lodestone
