// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "lodestone/mesh/box.h"
#include "lodestone/triangles/triangle_intersection.h"

/// How far apart two triangles are. Triangles without area count as the segments or points they are; coordinates may
/// have any finite size. Distances are in the unit of the coordinates.
namespace lodestone {

/// Two points, and how far and in which direction the triangles they lie on are apart.
struct Closest_points {
  Point a;                                              ///< on the first triangle, up to rounding of its coordinates
  Point b;                                              ///< on the second
  double distance = 0;                                  ///< infinity where it exceeds the largest double
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit vector from b to a; zero where the distance is
};

/// Where two triangles come nearest to each other; of several such places always the same.
///
/// `distance` has a relative error below 2^-30 where it is a normal number, however thin or nearly parallel the
/// triangles are. It is zero if and only if `triangles_intersect`; then a and b are one point of the intersection.
/// `direction` mostly has an error near 10^-15 times the triangles' size over their distance, and near 10^-15 where
/// that is so large that exact arithmetic takes over; never above 10^-4. Both come from the triangles, not from a and
/// b, which are rounded to double: far from the origin these may lie a few last digits of their coordinates off.
///
/// A pair of places computed in double is the answer if a plane between the triangles proves that no nearer pair
/// exists. Otherwise, mostly at distances below 10^-6 of the triangles' size, exact arithmetic takes over, which is
/// hundreds of times slower.
Closest_points closest_points(const Triangle& a, const Triangle& b);

/// Whether two triangles intersect or have points nearer to each other than `distance`: exact, and strict, so that
/// triangles exactly `distance` apart are not. For a `distance` of zero or less: whether they intersect.
///
/// Floating point decides only what it can prove: 'no' by a plane between the triangles with their distance from it
/// rounded down, 'yes' by one pair of their points in interval arithmetic. Exact arithmetic decides the rest.
bool triangles_nearer_than(const Triangle& a, const Triangle& b, double distance);

/// A lower bound of the distance of two boxes, not empty: 0 if they overlap, otherwise rounded down. Some ten flops.
///
/// Falls short by a few roundings; by a factor of at most sqrt(3) for distances outside 10^-150 to 10^150.
double distance_lower_bound(const Box& a, const Box& b);

}  // namespace lodestone
