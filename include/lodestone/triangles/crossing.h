// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace lodestone {

/// A guess at how two triangles a and b intersect: an edge of one passes through the interior of the other.
///
/// Edge i goes from corner i to the next. Edge i of a has the code i, and edge i of b the code 3 + i. The code is
/// larger by 6 if the edge starts below the other triangle. Above is the side from which the corners of a triangle are
/// seen counter-clockwise.
using Crossing = std::uint8_t;
/// No guess.
inline constexpr Crossing no_crossing = 12;

}  // namespace lodestone
