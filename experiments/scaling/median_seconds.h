// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "program/measurement.h"
#include "shared/lap_timer.h"

namespace lodestone {

inline constexpr int runs_per_figure = 5;

/// The median of the times that a function takes.
template <class Function>
double median_seconds(Function function) {
  std::vector<double> seconds;
  for (int run = 0; run < runs_per_figure; ++run) {
    const Lap_timer timer;
    function();
    seconds.push_back(timer.seconds());
  }
  return median(std::move(seconds));
}

}  // namespace lodestone
