// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace lodestone {

/// Coordinates of all vertices in one frame, by vertex index: x, y, z, x, y, z, ...; 3 V values.
using Coordinates = std::span<const double>;

/// Whether no number is infinite or NaN. O(n).
inline bool all_finite(std::span<const double> numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

}  // namespace lodestone
