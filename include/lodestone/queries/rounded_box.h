// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace lodestone {

/// The box of a face, or of several, in coordinates rounded to the nearest float: boxes that meet still meet, but a box
/// need not enclose its faces. Its highest corner is negated, so that one kind of comparison serves all six sides.
struct alignas(32) Rounded_box {
  float low[3];           ///< lower corner
  std::uint32_t index;    ///< of the face in a list; of no meaning for a box around several
  float negated_high[3];  ///< upper corner, times -1
  std::uint32_t unused;   ///< padding: a vector holds a whole box

  /// Upper end along an axis.
  float high(int axis) const { return -negated_high[axis]; }
  /// Length along an axis.
  float side(int axis) const { return high(axis) - low[axis]; }
  /// Twice the middle along an axis.
  float twice_centre(int axis) const { return low[axis] + high(axis); }

  /// Whether two boxes have a point in common.
  friend bool meet(const Rounded_box& a, const Rounded_box& b) {
    for (int axis = 0; axis < 3; ++axis)
      if (a.low[axis] > b.high(axis) || b.low[axis] > a.high(axis)) return false;
    return true;
  }
};

}  // namespace lodestone
