// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>

#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// The ends of the segment in which two triangles cross, each coordinate rounded to the nearest double.
using Crossing_segment = std::array<Point, 2>;

/// Crossing segments of several pairs of triangles at once.
/// @param pairs     at most `most_crossing_pairs`
/// @param segments  one per pair: none if the triangles do not cross, if a corner or edge of one touches the other, or
///                  if the rounding cannot be proven without exact numbers
void crossing_segments(std::span<const Triangle_pair> pairs, std::span<std::optional<Crossing_segment>> segments);

/// So many pairs fill the widest vectors of a processor.
inline constexpr std::size_t most_crossing_pairs = 4;

}  // namespace lodestone
