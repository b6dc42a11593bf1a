// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/read_bound.h"

#include <algorithm>
#include <array>
#include <limits>

namespace lodestone {

namespace {

/// Coordinates per step: those of eight points. Each lane has extremes of its own, so no minimum waits for the last.
constexpr std::size_t lanes = 24;

struct Extremes {
  std::array<double, lanes> low, high;
};

#if defined(__x86_64__) && defined(__gnu_linux__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void extend(const double* coordinates, std::size_t steps, Extremes& extremes) {
  Extremes running = extremes;
  for (std::size_t step = 0; step < steps; ++step, coordinates += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double x = coordinates[lane];
      running.low[lane] = x < running.low[lane] ? x : running.low[lane];
      running.high[lane] = x > running.high[lane] ? x : running.high[lane];
    }
  extremes = running;
}

}  // namespace

Box read_every_vertex(std::span<const double> coordinates) {
  Extremes extremes;
  extremes.low.fill(std::numeric_limits<double>::infinity());
  extremes.high.fill(-std::numeric_limits<double>::infinity());
  const std::size_t steps = coordinates.size() / lanes;
  extend(coordinates.data(), steps, extremes);
  Box box;
  for (std::size_t i = steps * lanes; i < coordinates.size(); i += 3)
    box.extend(Eigen::Vector3d(coordinates[i], coordinates[i + 1], coordinates[i + 2]));
  if (steps == 0) return box;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    auto &low = box.min()[static_cast<int>(lane % 3)], &high = box.max()[static_cast<int>(lane % 3)];
    low = std::min(low, extremes.low[lane]);
    high = std::max(high, extremes.high[lane]);
  }
  return box;
}

}  // namespace lodestone
