// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace lodestone {

/// A guess at how two triangles a and b intersect: an edge of one passes through the inside of the other.
///
/// Edge i goes from corner i to the next. Its number is i if it is one of a's, 3 + i if it is one of b's, and 6 more if
/// it starts below the other triangle, whose corners are seen counter-clockwise from above.
using Crossing = std::uint8_t;
inline constexpr Crossing no_crossing = 12;

}  // namespace lodestone
