// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace lodestone {

/// Measures seconds since its construction or the last lap.
class Lap_timer {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Returns the seconds and starts again from 0.
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_ = Clock::now();
};

}  // namespace lodestone
