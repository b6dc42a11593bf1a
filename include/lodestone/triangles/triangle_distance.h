// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "lodestone/mesh/box.h"
#include "lodestone/triangles/triangle_intersection.h"

/// How far apart two triangles are. A triangle without area counts as the segment or point that it is. Coordinates may
/// have any finite size. Distances are in the unit of the coordinates.
namespace lodestone {

/// The closest points of two triangles, and the distance and direction between the triangles.
struct Closest_points {
  Point a;                                              ///< on the first triangle, up to rounding of its coordinates
  Point b;                                              ///< on the second
  double distance = 0;                                  ///< infinity if it exceeds the largest double
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit vector from b to a; zero if the distance is zero
};

/// The closest points of two triangles. If several pairs of points are equally close, the choice is deterministic.
///
/// `distance` has a relative error below 2^-30 if it is a normal number, however thin or nearly parallel the triangles
/// are. It is zero if and only if `triangles_intersect`; a and b are then the same point of the intersection. The error
/// of `direction` is mostly near 10^-15 times the triangles' size over their distance; it is smaller where more digits
/// are needed to know the distance, and never above 10^-4. Distance and direction are computed from the triangles, not
/// from a and b. These two are rounded to double, so far from the origin they may be off by a few last digits of their
/// coordinates.
///
/// A pair of points computed in double is accepted if a plane between the triangles proves that no nearer pair exists.
/// Otherwise, mostly at distances below 10^-6 of the triangles' size, double-double takes over, which is some ten times
/// slower. Exact arithmetic, hundreds of times slower, decides what the error bounds of double-double leave open: thin
/// triangles, and distances below some 10^-20 of the size.
Closest_points closest_points(const Triangle& a, const Triangle& b);

/// Whether two triangles intersect or have points nearer to each other than `distance`. Exact, and strict: triangles
/// exactly `distance` apart are not nearer. For a `distance` of zero or less: whether they intersect.
///
/// Floating point decides only what it can prove: 'no' by a plane between the triangles, with the distance across it
/// rounded down; 'yes' by one pair of their points, in interval arithmetic. The same two proofs in exact arithmetic
/// decide most of the rest.
bool triangles_nearer_than(const Triangle& a, const Triangle& b, double distance);
/// Whether floating point proves two corners nearer to each other than `distance`, so that the triangles are too. If it
/// does not, they can be nearer all the same. Some nanoseconds, where `triangles_nearer_than` takes a microsecond.
bool corners_nearer_than(const Triangle_corners& a, const Triangle_corners& b, double distance);
/// Whether the boxes of two triangles, whose sides are coordinates of corners, have a point in common. Exact.
inline bool boxes_meet(const Triangle_corners& a, const Triangle_corners& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low_a, high_a] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
    const auto [low_b, high_b] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
    if (low_a > high_b || low_b > high_a) return false;
  }
  return true;
}

/// Lower bound on the distance of two non-empty boxes: 0 if they overlap, otherwise the distance rounded down.
///
/// Where the boxes are apart along one axis alone, the bound is the distance, rounded down once. Else it falls short by
/// a few roundings. For distances outside 10^-150 to 10^150 it falls short by a factor of at most sqrt(3). Some twenty
/// floating-point operations.
double distance_lower_bound(const Box& a, const Box& b);

}  // namespace lodestone
