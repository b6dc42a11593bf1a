// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/leaf_faces.h"

/// One leaf and a point, built for several instruction sets and chosen at run time. All give the same bits.
namespace lodestone::kernel {

/// A point as the kernel reads it: see `Query_point`.
struct Point_input {
  double scaled[4];  ///< x, y and z times `scale`, and 0
  double scale;
};

/// Bounds on the rounding of squared distances, which are sums of three squares.
constexpr double distance_roundings = 0x1p-48, distance_underflow = 0x1p-1000;

/// Lists the faces of a leaf that floating point does not prove to be farther than `most`, a squared scaled distance.
/// @param leaf        its list of vertices is padded with a vector of other vertices of the mesh
/// @param most        lowered to an upper bound on the distance of the nearest face, if that is less
/// @param candidates  room for `most_leaf_faces`; indices in the list of faces, ascending
/// @return number of candidates
std::size_t list_near_faces(const Leaf_faces& leaf, const Point_input& point, double& most, std::uint8_t* candidates);

}  // namespace lodestone::kernel
