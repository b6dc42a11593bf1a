// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "triangles/most_planes.h"

namespace lodestone::kernel {

/// Edges, and for each a triangle whose plane it crosses. The last index is that of the edge.
struct Edges_and_planes {
  std::size_t count = 0;                 ///< of edges; what follows them is ignored
  double plane[3][3][most_planes] = {};  ///< [corner][axis]
  double from[3][most_planes] = {}, to[3][most_planes] = {};
};

/// Where the edges cross the planes.
struct Crossing_points {
  double coordinates[3][most_planes];
  /// Whether the coordinates are the nearest doubles to the exact ones; if not, they mean nothing.
  std::array<bool, most_planes> proven;
};

/// @param edges  the ends of each edge lie on different sides of its plane
void crossing_points(const Edges_and_planes& edges, Crossing_points& points);

}  // namespace lodestone::kernel
