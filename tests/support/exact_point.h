// SPDX-License-Identifier: GPL-3.0-or-later
// Exact numbers and points.
#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Core>
#include <array>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

using Rational = CGAL::Exact_rational;
using Exact_point = CGAL::Point_3<CGAL::Simple_cartesian<Rational>>;
using Exact_vector = CGAL::Vector_3<CGAL::Simple_cartesian<Rational>>;
using Exact_triangle = std::array<Exact_point, 3>;

Exact_point exact_point(const double* p);
Exact_point exact_point(const Point& p);
Exact_point exact_point(const Eigen::Vector3d& p);

/// The point of a triangle, segment or point that is nearest to another.
Exact_point nearest_point(const Exact_triangle& t, const Exact_point& c);

}  // namespace lodestone
