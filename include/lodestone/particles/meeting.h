// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/particles/walked_surface.h"

namespace lodestone {

/// Where two particles of different objects are while they meet.
struct Meeting {
  std::uint32_t a = 0;  ///< vertex of the first object
  std::uint32_t b = 0;  ///< vertex of the second object
};

/// A meeting that has ended: neither particle can get nearer to the other by one step, or the walk became too long.
struct Ended_meeting {
  Meeting at;                     ///< where both are at the end
  double squared_distance = 0;    ///< of the two vertices, in squared units of the coordinates
  std::size_t hops = 0;           ///< of both particles together
  std::size_t vertices_read = 0;  ///< positions read, some of them more than once
};

/// Lets two particles walk towards each other: in turns, each goes from vertex to neighbouring vertex for as long as it
/// gets nearer to the other, also over the borders of regions. Ties go to the lowest vertex index.
///
/// This is not in \cite saenghaengtham2006, whose particles can rest across the lens of two surfaces that have sunk
/// into each other, because the force 1 / r^2 sums over all particles. O(d) reads per hop, for vertices of d
/// neighbours.
///
/// @param start  from where they walk
/// @param most_hops  the walk ends after so many
/// @throws Bad_mesh  a coordinate that is read is not finite
Ended_meeting meet(const Walked_surface& a, const Walked_surface& b, Meeting start, std::size_t most_hops);

}  // namespace lodestone
