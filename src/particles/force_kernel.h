// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace lodestone::kernel {

/// Attractors as columns of coordinates, and the squared reach of each.
struct Attractor_columns {
  const double* x;
  const double* y;
  const double* z;
  const double* squared_reach;
};

inline constexpr std::size_t point_lanes = 8;

/// Adds to the force at each of eight points the sum of 1 / r^2 over the attractors from `begin` to `end` whose reach
/// is above their distance r. Built for several instruction sets and chosen at run time; all give the same bits.
void add_forces(const Attractor_columns& attractors, std::size_t begin, std::size_t end, const double* x,
                const double* y, const double* z, double* forces);

}  // namespace lodestone::kernel
