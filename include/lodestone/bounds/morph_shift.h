// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace lodestone {

/// What morph targets add to the coordinates of some vertices, along x, y and z. The fourth numbers mean nothing.
///
/// Take any of these vertices, such as those of one joint, and let [r, s] be their range along an axis at rest. With
/// m = max(|r|, |s|), their computed coordinates lie in
///
///     [r + low - margin, s + high + margin],  margin = rounding (m + magnitude) + underflow.
///
/// That also holds if the two ends are computed in doubles, from left to right.
struct Morph_shift {
  std::array<double, 4> low = {};        ///< the least sums
  std::array<double, 4> high = {};       ///< the greatest sums
  std::array<double, 4> magnitude = {};  ///< sums of the greatest absolute terms
  double rounding = 0;                   ///< (4 k + 16) 2^-53 for k targets whose weight is not 0; 0 if k is 0
  double underflow = 0;                  ///< k 2^-1020, for products below the normal numbers
};

}  // namespace lodestone
