// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>

#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// A direction in which to move one of two triangles, and a distance after which they touch at most.
struct Contact_normal {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector, from the inside of b towards a; or zero
  double depth = 0;  ///< unit of the coordinates; >= 0 if they intersect, minus the distance if they are apart
};

/// Normal and depth of the contact of two intersecting faces a and b, whose corners are counter-clockwise seen from
/// outside.
///
/// With the unit normals n_a and n_b of the faces, the contact normal is n_b - n_a, divided by its length: a is pushed
/// along the outward normal of b and against its own. The exceptions are
///  - n_b if that difference is shorter than 10^-8 (both faces point the same way), and if a has no area;
///  - -n_a if b has no area;
///  - zero if neither has an area.
///
/// Whether a face has an area is decided exactly. The error of a face's normal is below 10^-8, and near
/// 10^-15 if the face is not thin. In the contact normal it is divided by the length of n_b - n_a.
///
/// The depth is how far a must move along the normal until the projections of both triangles onto it only touch: the
/// maximum of normal . x over b, minus the minimum over a. It is zero if the normal is zero or the projections are
/// apart. It separates these two triangles; `parting` separates the objects that they belong to. Its rounding error is
/// some 10^-15 of their extent.
///
/// The result is never NaN. The depth is finite for coordinates up to 10^307. `contact_normal(b, a)` is the opposite
/// normal with the same depth, unless both faces point the same way.
Contact_normal contact_normal(const Triangle& a, const Triangle& b);
/// That of each pair: faster than one after the other.
/// @param normals  one per pair, to be written
void contact_normals(std::span<const Triangle_pair> pairs, std::span<Contact_normal> normals);

/// The same for two triangles a and b that are near but apart, from their closest points: `normal` points from b to a,
/// and `depth` is minus their distance. The errors are those of `closest_points`.
Contact_normal gap_normal(const Closest_points& nearest);

}  // namespace lodestone
