// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Bbox_3.h>

#include <span>

#include "io/motion/deformed_shape.h"

namespace lodestone::detail {

/// How much farther apart than at rest deformed points can be.
struct Expansion {
  double constant = 1;  ///< L: exact positions of two points are at most L times as far apart as at rest
  double error = 0;     ///< e: a computed position is at most this far from the exact one
};

/// What deformations do to points in one frame, at most. Infinite, without error, where numbers overflow.
///
/// L is the product of the constants of all steps. That of a step is the largest singular value of its derivative,
/// wherever points can be before it: in a convex set of which this function keeps a ball and a box, both around the
/// shape's middle c. Let d = x - c, |d| <= D, and I the identity matrix.
///
/// - Wobble: the derivative is I + h k P, and each row of P has a single entry, a cosine, in another column.
///   L = 1 + |h k|.
/// - Bend: moving along `axis` by du moves the bent point by |1 - K w| du, along the arc; moving along `towards`, or
///   perpendicular to both, by dw moves it by dw at right angles to that. L = max |1 - K w|, at least 1.
/// - Twist: the rotation by the angle of x, times I + t e a^T, where a is the axis, e at right angles to it, and
///   t = |rate| r at distance r from the axis. This is a shear: L = t / 2 + sqrt(1 + t^2 / 4) for the largest r.
/// - Inflate: L is the factor. Travel, Spin: L = 1.
///
/// With u = 2^-53 and m = |c|, each step adds less than 64 u times the following to the error, after the errors so far
/// have been multiplied by its L. Sines of an angle computed with an error are off by this error, and by 2 u.
///
/// - Wobble, whose angles are up to |k| D + |a| + 5: |h| (|k| D + |a| + 8) + m + D.
/// - Bend and twist, whose angles are up to |K| D: m + D (1 + |K| D). Bend has 16 o D (1 + |K| D) besides, since its
///   two directions are unit vectors at right angles only up to o.
/// - Inflate: m + D (1 + factor). Travel: m + D + |way|. Spin: m + D.
///
/// The set grows by the error, and lengths are 10^-9 longer, which covers the rounding of all this; L by 10^-12.
///
/// @param rest  the box of the points before the first step
Expansion expansion(std::span<const Step> steps, const Point& middle, const CGAL::Bbox_3& rest);

}  // namespace lodestone::detail
