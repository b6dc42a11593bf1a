// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// The ends of the segment in which two triangles cross, each coordinate rounded to the nearest double.
/// @return none if the triangles do not cross, if a corner or edge of one touches the other, or if the rounding cannot
///         be proven without exact numbers
std::optional<std::array<Point, 2>> crossing_segment(const Triangle& a, const Triangle& b);

}  // namespace lodestone
