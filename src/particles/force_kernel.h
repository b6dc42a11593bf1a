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

/// Adds to each of eight forces the sum of 1 / r^2 over the attractors from `begin` to `end` at r below their reach.
/// Built for several instruction sets; all give the same bits.
void add_forces(const Attractor_columns& attractors, std::size_t begin, std::size_t end, const double* x,
                const double* y, const double* z, double* forces);

}  // namespace lodestone::kernel
