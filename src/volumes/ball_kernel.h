// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/leaf_faces.h"

/// Loops over the vertices of a leaf that fit volumes bounded by spheres, built for several instruction sets and chosen
/// at run time. All round alike, so all give the same bits.
namespace lodestone::kernel {

/// The vertices of a leaf in columns, one per coordinate.
struct Leaf_points {
  static constexpr std::size_t capacity = 3 * most_leaf_faces;
  static constexpr std::size_t step = 8;  ///< columns are padded with the last vertex to a multiple of this

  alignas(64) double x[capacity];
  alignas(64) double y[capacity];
  alignas(64) double z[capacity];
  std::size_t count;  ///< vertices
  std::size_t size;   ///< the same with the padding
};

/// Copies the vertices of a leaf. Reads nothing past the z of the last one.
void gather(const Leaf_faces& faces, Leaf_points& points);

struct Farthest {
  std::size_t index;        ///< of the vertex, or of one whose squared distance is at least 1 - 2^-43 times its
  double squared_distance;  ///< the largest: (x x + y y) + z z, each sum and product rounded
};

/// The vertex farthest from a point.
Farthest farthest(const Leaf_points& points, const double* centre);

struct Sum {
  double x, y, z;
};

/// The sum of the vertices as seen from a point.
Sum sum(const Leaf_points& points, const double* origin);

/// Means of products of coordinates; r stands for x x + y y + z z.
struct Sphere_moments {
  double xx, xy, yy, yz, zz, zx, rx, ry, rz, rr;
};

/// The moments of the vertices as seen from a point, times a factor.
Sphere_moments sphere_moments(const Leaf_points& points, const double* origin, double factor);

struct Directions {
  double least_squared_distance;
  double most_squared_distance;
  double least_cosine;  ///< of the angles at the centre between vertices and axis; undefined if a vertex is the centre
};

/// How far vertices are from a centre, and how far off an axis.
/// @param squared_distances  set, one per vertex, each computed as `Farthest` says; aligned to 64 bytes, with room for
///                           `Leaf_points::capacity`
Directions directions(const Leaf_points& points, const double* centre, const double* axis, double* squared_distances);

}  // namespace lodestone::kernel
