// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Axis-aligned box, the volume of \cite cohen1995 and \cite held1995. Minima and maxima of coordinates do not round,
/// so it is the smallest such box. Model of Bounding_volume.
///
/// Padded to four lanes, so that one vector instruction handles all three axes; the fourth lane is unspecified.
struct alignas(64) Aabb {
  static constexpr std::string_view name = "aabb";  ///< in tables and messages

  double low[4];   ///< x, y, z of the lower corner
  double high[4];  ///< x, y, z of the upper corner

  /// The smallest box around the faces. O(V) for V vertices.
  void enclose(const Leaf_faces& faces);
  /// The smallest box around both.
  void enclose(const Aabb& a, const Aabb& b) {
    for (int lane = 0; lane < 4; ++lane) {
      low[lane] = a.low[lane] < b.low[lane] ? a.low[lane] : b.low[lane];
      high[lane] = a.high[lane] > b.high[lane] ? a.high[lane] : b.high[lane];
    }
  }
  /// Sum of the three side lengths; infinite on overflow.
  double extent() const { return (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]); }
  /// Product of the three side lengths; infinite on overflow.
  double volume() const { return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]); }
  /// The box itself.
  Aabb bounds() const { return *this; }

  /// Whether both corners are the same; the fourth lane does not count.
  friend bool operator==(const Aabb& a, const Aabb& b) {
    bool equal = true;
    for (int axis = 0; axis < 3; ++axis) equal &= (a.low[axis] == b.low[axis]) & (a.high[axis] == b.high[axis]);
    return equal;
  }
};

/// Whether no part of a box is outside another.
inline bool contains(const Aabb& outer, const Aabb& inner) {
  bool result = true;
  for (int axis = 0; axis < 3; ++axis)
    result &= (outer.low[axis] <= inner.low[axis]) & (inner.high[axis] <= outer.high[axis]);
  return result;
}

/// What the squared distance of boxes, as computed, exceeds only if they are farther apart than the margin.
///
/// The gaps, their squares and the sums make six roundings of each square, and the square of the margin has one. 64 are
/// allowed for, and 1e-300 for what squares lose below the normal numbers. If the square of the margin, with the
/// allowance, is finite, a sum that overflows is greater.
inline double most_squared_gap(double margin) { return margin * margin * (1 + 0x1p-47) + 1e-300; }

/// Whether two boxes come within `margin` >= 0 of each other; with 0: whether they have a point in common. `false`
/// proves them farther apart. Along each axis rounding to nearest is monotonic: where the exact sum is at least a
/// double, so is the rounded sum.
inline bool near(const Aabb& a, const Aabb& b, double margin) {
  bool result = true;
  for (int axis = 0; axis < 3; ++axis)
    result &= (a.low[axis] <= b.high[axis] + margin) & (b.low[axis] <= a.high[axis] + margin);
  if (margin == 0 || !result) return result;
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double above = a.low[axis] - b.high[axis], below = b.low[axis] - a.high[axis];
    const double gap = above > below ? above : below;
    squared += gap > 0 ? gap * gap : 0;
  }
  return squared <= most_squared_gap(margin);
}

}  // namespace lodestone
