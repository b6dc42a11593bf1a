// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace lodestone {

/// Runs `stage` and adds the time that it takes to `seconds`.
template <class Stage>
void timed(double& seconds, Stage stage) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  stage();
  seconds += std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace lodestone
