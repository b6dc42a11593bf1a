// SPDX-License-Identifier: GPL-3.0-or-later
// The distance of two triangles in rational arithmetic.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lodestone/triangles/triangle_intersection.h"
#include "support/exact_point.h"
#include "support/number_vectors.h"

namespace lodestone {

using Rational_vector = std::array<Rational, 3>;

/// Squared distance of two triangles, segments or points: zero if they have a common point, otherwise that of the
/// origin from the convex hull of the nine differences of their corners. Its nearest point lies on the border of the
/// hull, in the hull of at most three differences, where the foot of the perpendicular from the origin is.
Rational exact_squared_distance(const Triangle& a, const Triangle& b);

}  // namespace lodestone
