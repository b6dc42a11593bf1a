// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/volumes/aabb.h"

/// Boxes that grow, rounded outwards.
namespace lodestone {

/// The next greater double, as std::nextafter gives it, which is not inlined.
inline double next_above(double x) {
  if (!(x < std::numeric_limits<double>::infinity())) return x;
  if (x == 0) return std::numeric_limits<double>::denorm_min();
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return std::bit_cast<double>(x > 0 ? bits + 1 : bits - 1);
}
/// The next smaller double.
inline double next_below(double x) { return -next_above(-x); }

/// A box that contains every point within `distance` of a box, also points whose coordinates are no doubles. Unchanged
/// if the distance is 0; axes that overflow, or that are not finite, are open.
inline Aabb grown(const Aabb& from, double distance) {
  Aabb box = from;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (distance != 0) {
      box.low[axis] = next_below(box.low[axis] - distance);
      box.high[axis] = next_above(box.high[axis] + distance);
    }
    open_if_not_finite(box, axis);
  }
  return box;
}

/// A box that contains every point within `distance` of `centre`.
inline Aabb box_around(const Eigen::Vector3d& centre, double distance) {
  return grown({.low = {centre.x(), centre.y(), centre.z(), 0}, .high = {centre.x(), centre.y(), centre.z(), 0}},
               distance);
}

}  // namespace lodestone
