// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace lodestone::kernel {

/// Two edges, and for each a triangle whose plane it crosses. The last index is that of the edge, so that both fit in
/// one vector.
struct Edges_and_planes {
  double plane[3][3][2];  ///< [corner][axis]
  double from[3][2], to[3][2];
};

/// Where the edges cross the planes.
struct Crossing_points {
  double coordinates[3][2];
  bool proven;  ///< all coordinates are the nearest doubles to the exact ones; else they mean nothing
};

/// @param edges  the ends of each edge lie on different sides of its plane
void crossing_points(const Edges_and_planes& edges, Crossing_points& points);

}  // namespace lodestone::kernel
