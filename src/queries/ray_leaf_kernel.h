// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

/// One leaf and a ray, built for several instruction sets and chosen at run time. All give the same candidates.
namespace lodestone::kernel {

/// A ray as the kernel reads it: see `Ray_frame`.
struct Ray_input {
  double origin[3];
  double shear[3];  ///< by axis; of no meaning for the axis of the depth
  double sign;
  int depth_axis;
};

/// The largest coordinate of a point of a box, as seen from an origin.
inline double reach(const Aabb& box, const double* origin) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis)
    most = std::max({most, std::abs(box.low[axis] - origin[axis]), std::abs(box.high[axis] - origin[axis])});
  return most;
}

/// Lists the faces of a leaf that floating point does not prove missed: those whose corners are not all on one side of
/// the ray, seen along it in eight directions, nor all behind its origin or beyond a depth.
/// @param vertices    of the leaf, padded with a vector of other vertices of the mesh
/// @param error       see `frame_error`
/// @param most_depth  >= 0
/// @param candidates  room for `most_leaf_faces`; indices in the list of faces, ascending
/// @return number of candidates
std::size_t list_ray_candidates(const Leaf_faces& leaf, const Ray_input& ray, double error, double most_depth,
                                std::uint8_t* candidates);

}  // namespace lodestone::kernel
