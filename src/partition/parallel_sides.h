// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>

namespace lodestone {

/// Whether two sides of a face are parallel but for rounding: then their cross product is nothing but rounding error,
/// with an arbitrary direction.
/// @param first, second  at most a few units long, so that their squares do not overflow
inline bool parallel_sides(const Eigen::RowVector3d& first, const Eigen::RowVector3d& second,
                           const Eigen::RowVector3d& cross) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  // Most faces are far from that, and their squares from underflow: saves three roots.
  const double squared = cross.squaredNorm();
  if (squared > 1e-200 && squared > 4 * rounding * rounding * first.squaredNorm() * second.squaredNorm()) return false;
  return cross.norm() <= rounding * first.norm() * second.norm();
}

}  // namespace lodestone
