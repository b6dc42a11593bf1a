// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "lodestone/contact/crossing.h"

namespace lodestone {

/// Axis-aligned box of a tree node. Four lanes, so that one vector instruction handles a side of it; the fourth means
/// nothing.
struct alignas(64) Tree_box {
  double low[4];
  double high[4];
};

/// Whether two boxes come within `margin` >= 0 of each other along every axis; with 0: whether they have a point in
/// common. `false` proves them farther apart: a sum rounded to nearest is never below a double that the true sum is
/// not below.
inline bool near(const Tree_box& a, const Tree_box& b, double margin) {
  bool result = true;
  for (int axis = 0; axis < 3; ++axis)
    result &= (a.low[axis] <= b.high[axis] + margin) & (b.low[axis] <= a.high[axis] + margin);
  return result;
}

/// Sum of the three sides; infinite where the true sum is beyond all doubles.
inline double extent(const Tree_box& box) {
  return (box.high[0] - box.low[0]) + (box.high[1] - box.low[1]) + (box.high[2] - box.low[2]);
}

/// The corners of a face as places in the vertex list of its leaf, which has at most 3 x 128 vertices.
using Leaf_corners = std::array<std::uint16_t, 3>;

/// Two faces by their places in the lists of their leaves.
struct Face_places {
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  Crossing crossing = no_crossing;
};

}  // namespace lodestone
