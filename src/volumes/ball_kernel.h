// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/leaf_faces.h"

/// Loops over the vertices of a leaf, for volumes bounded by spheres. Built for several instruction sets and chosen at
/// run time. Roundings are the same in all of them, and so are the results.
namespace lodestone::kernel {

/// Vertices of a leaf as a structure of arrays, for vector loads.
struct Leaf_points {
  static constexpr std::size_t capacity = 3 * most_leaf_faces;
  static constexpr std::size_t step = 8;  ///< padded to a multiple of this with copies of the last vertex

  alignas(64) double x[capacity];
  alignas(64) double y[capacity];
  alignas(64) double z[capacity];
  std::size_t count;  ///< vertices without padding
  std::size_t size;   ///< vertices with padding
};

/// Copies the vertices of a leaf. Reads nothing past the coordinates of the last one.
/// @param vertices  `count` indices, ascending; at least one and at most the capacity
void gather(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Leaf_points& points);

struct Farthest {
  std::size_t index;  ///< of the farthest vertex, or of one whose squared distance is at least 1 - 2^-43 of the largest
  double squared_distance;  ///< the largest: x x + y y + z z with each sum and product rounded
};

/// The vertex farthest from a point.
Farthest farthest(const Leaf_points& points, const double* centre);

struct Sum {
  double x, y, z;
};

/// Sum over all vertices of vertex - origin.
Sum sum(const Leaf_points& points, const double* origin);

/// Means of products of coordinates; r is x x + y y + z z.
struct Sphere_moments {
  double xx, xy, yy, yz, zz, zx, rx, ry, rz, rr;
};

/// Moments of (vertex - origin) factor over all vertices.
Sphere_moments sphere_moments(const Leaf_points& points, const double* origin, double factor);

struct Directions {
  double least_squared_distance;
  double most_squared_distance;
  double least_cosine;  ///< of the angles at the centre between vertices and the axis; unspecified if a vertex is there
};

/// The range of the vertices' distances from a centre, and of their angles to an axis.
/// @param squared_distances  output per vertex, computed as in `farthest`; aligned to 64 bytes, with room for
/// `capacity`
Directions directions(const Leaf_points& points, const double* centre, const double* axis, double* squared_distances);

}  // namespace lodestone::kernel
