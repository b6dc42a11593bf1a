// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/leaf_faces.h"

/// Loops over the vertices of a leaf for volumes that are bounded by spheres, built for several instruction sets and
/// chosen at run time. Each vertex has the same roundings in all of them, so all give the same results.
namespace lodestone::kernel {

/// Vertices of a leaf, coordinate by coordinate, where vectors find them side by side.
struct Leaf_points {
  static constexpr std::size_t capacity = 3 * most_leaf_faces;
  static constexpr std::size_t step = 8;  ///< the last vertex is repeated until they are a multiple of this

  alignas(64) double x[capacity];
  alignas(64) double y[capacity];
  alignas(64) double z[capacity];
  std::size_t count;  ///< vertices
  std::size_t size;   ///< the same with the repetitions
};

/// Copies the vertices of a leaf. Reads nothing past the coordinates of the last one.
/// @param vertices  `count` numbers, at least one and at most the capacity, ascending
void gather(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Leaf_points& points);

struct Farthest {
  std::size_t place;        ///< of the vertex, or of one that is as far up to a factor of 1 - 2^-43
  double squared_distance;  ///< the largest one: computed as x x + y y + z z with each sum and product rounded
};

/// The vertex farthest from a point.
Farthest farthest(const Leaf_points& points, const double* centre);

struct Sum {
  double x, y, z;
};

/// Of the vertices seen from a point.
Sum sum(const Leaf_points& points, const double* origin);

/// Means of products of coordinates; r stands for x x + y y + z z.
struct Sphere_moments {
  double xx, xy, yy, yz, zz, zx, rx, ry, rz, rr;
};

/// Of the vertices seen from a point, times a factor.
Sphere_moments sphere_moments(const Leaf_points& points, const double* origin, double factor);

struct Directions {
  double least_squared_distance;
  double most_squared_distance;
  double least_cosine;  ///< of the angle between a vertex and the axis, seen from the centre; means nothing if a vertex
                        ///< is there
};

/// How far vertices are from a centre, and how far off an axis.
/// @param squared_distances  aligned to 64 bytes, with room for `capacity`; gets that of each vertex: computed as those
/// of `farthest` are
Directions directions(const Leaf_points& points, const double* centre, const double* axis, double* squared_distances);

}  // namespace lodestone::kernel
