// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Where an edge crosses the plane of a triangle: each coordinate is the nearest double.
/// @param from, to  on different sides of the plane
Point exact_crossing(const Point& from, const Point& to, const Triangle& plane);

using Rational_kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;

Rational_kernel::Point_3 rational(const Point& p);
/// Each coordinate is the nearest double.
Point nearest_point(const Rational_kernel::Point_3& p);

}  // namespace lodestone
