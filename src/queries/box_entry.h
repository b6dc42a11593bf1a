// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lodestone/volumes/aabb.h"
#include "triangles/ray_depth.h"

/// Where rays enter boxes, as far as floating point can tell.
namespace lodestone {

/// Where a ray enters a box.
struct Ray_entry {
  double depth;  ///< a lower bound on it
  bool is_hit;   ///< false: the ray is proven to miss the box, and `depth` means nothing

  /// Whether the ray may be in the box at a depth. Without branches, since which boxes are hit is unpredictable.
  std::size_t is_hit_within(double most_depth) const {
    return static_cast<std::size_t>(is_hit) & static_cast<std::size_t>(depth <= most_depth);
  }
};

/// Tells where a ray enters boxes, by the slabs between their sides \cite kay1986.
///
/// A depth is a difference times the inverse of a slope, each rounded once, and so is their product: three roundings
/// in all. Eight are allowed for.
class Box_entry {
 public:
  static constexpr double largest = std::numeric_limits<double>::max();  ///< no depth is larger

  explicit Box_entry(const Ray_frame& frame) {
    const double d_z = std::abs(frame.direction[frame.axes[2]]);
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = frame.origin[axis];
      is_orthogonal_[axis] = frame.direction[axis] == 0;
      inverse_[axis] = d_z / frame.direction[axis];
      near_side_[axis] = inverse_[axis] >= 0 ? axis : high + axis;
      far_side_[axis] = inverse_[axis] >= 0 ? high + axis : axis;
      is_steep_ |= !std::isfinite(inverse_[axis]);
    }
  }

  [[gnu::always_inline]] Ray_entry operator()(const Aabb& box) const {
    if (is_steep_) return with_steep_axes(box);
    const auto* const sides = reinterpret_cast<const double*>(&box);
    double enter = 0, leave = largest;
    for (int axis = 0; axis < 3; ++axis) {
      const double first = (sides[near_side_[axis]] - origin_[axis]) * inverse_[axis];
      const double last = (sides[far_side_[axis]] - origin_[axis]) * inverse_[axis];
      enter = first > enter ? first : enter;
      leave = last < leave ? last : leave;
    }
    return bound(enter, leave);
  }

 private:
  static constexpr double roundings = 0x1p-49, underflow = 0x1p-1000;
  static constexpr int high = 4;  ///< where the high sides of a box begin
  static_assert(sizeof(Aabb) == 2 * high * sizeof(double));

  static Ray_entry bound(double enter, double leave) {
    const double entered = enter < largest ? enter : largest;
    return {entered * (1 - roundings), entered <= leave * (1 + roundings) + underflow};
  }

  [[gnu::noinline]] Ray_entry with_steep_axes(const Aabb& box) const {
    const auto* const sides = reinterpret_cast<const double*>(&box);
    double enter = 0, leave = largest;
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(inverse_[axis])) {
        if (is_beside(box, axis)) return {0, false};
        continue;
      }
      enter = std::max(enter, (sides[near_side_[axis]] - origin_[axis]) * inverse_[axis]);
      leave = std::min(leave, (sides[far_side_[axis]] - origin_[axis]) * inverse_[axis]);
    }
    return bound(enter, leave);
  }

  /// Whether a ray that is orthogonal to an axis misses a box.
  bool is_beside(const Aabb& box, int axis) const {
    return is_orthogonal_[axis] && (origin_[axis] < box.low[axis] || origin_[axis] > box.high[axis]);
  }

  std::array<double, 3> origin_;
  std::array<bool, 3> is_orthogonal_;
  std::array<double, 3> inverse_;  ///< change of depth along each axis
  std::array<int, 3> near_side_;   ///< by which the ray enters: indices of numbers of a box
  std::array<int, 3> far_side_;    ///< by which it leaves
  bool is_steep_ = false;          ///< some inverse is infinite
};

}  // namespace lodestone
