// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

namespace lodestone {

/// Points without rounding, for deciding what lies in a volume.
using Exact_point = CGAL::Point_3<CGAL::Simple_cartesian<CGAL::Exact_rational>>;
using Exact_vector = CGAL::Vector_3<CGAL::Simple_cartesian<CGAL::Exact_rational>>;

inline Exact_point exact_point(const double* p) { return {p[0], p[1], p[2]}; }

}  // namespace lodestone
