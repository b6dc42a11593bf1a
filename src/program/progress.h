// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace lodestone {

/// Thrown where a run is given up because the user asked for it.
struct Interrupted {};

/// From here on an interrupt or termination signal ends the run at the next frame, with nothing half-written left.
/// A second one ends it at once; a hidden temporary file may then stay behind.
void handle_interrupts();
/// @throws Interrupted  the user has asked to stop
void check_interrupt();

/// A progress bar on the terminal. Silent when the output is no terminal or `quiet`.
class Progress_bar {
 public:
  Progress_bar(std::string label, bool quiet);
  ~Progress_bar();
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;

  /// Shows that `done` of `of` steps are done. Draws at most ten times a second.
  /// @throws Interrupted
  void operator()(std::size_t done, std::size_t of);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  bool shown_;
  bool drawn_ = false;
  Clock::time_point start_, last_drawn_;
};

}  // namespace lodestone
