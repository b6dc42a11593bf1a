// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Which way, and how far, one of two triangles would be pushed until they only touch.
struct Contact_normal {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector, from the inside of b towards a; or zero
  double depth = 0;  ///< unit of the coordinates; >= 0 if they intersect, minus their distance if they are apart
};

/// Normal and depth of the contact of two intersecting faces a and b, whose corners are counter-clockwise seen from
/// outside.
///
/// With unit normals n_a and n_b, the normal is n_b - n_a, divided by its length: a is pushed along the outside of b
/// and against its own. It is n_b where that difference is shorter than 10^-8 (both faces look the same way) and where
/// a has no area; -n_a where b has none; zero where neither has. Whether a face has an area is decided exactly; the
/// error of a normal is below 10^-8 for any face, and near 10^-15 for one that is not thin.
///
/// The depth is how far a must be moved along the normal until the projections of both onto it only touch: the greatest
/// of normal . x over b, less the least over a; zero where the normal is zero, and where the projections are apart. It
/// separates these two triangles, not the bodies they belong to. Its rounding is some 10^-15 of their extent.
///
/// Nothing is ever NaN; the depth is finite for coordinates up to 10^307. `contact_normal(b, a)` is the opposite normal
/// with the same depth, save where both faces look the same way.
Contact_normal contact_normal(const Triangle& a, const Triangle& b);

/// The same for two triangles a and b that are near but apart, by where they come nearest: `normal` points from b to a,
/// and `depth` is minus their distance. Errors are those of `closest_points`.
Contact_normal gap_normal(const Closest_points& nearest);

}  // namespace lodestone
