// SPDX-License-Identifier: GPL-3.0-or-later
// Which points lie in volumes that are bounded by spheres, decided exactly.
#pragma once

#include <cmath>

#include "exact_point.h"
#include "lodestone/contact/volumes/bounding_sphere.h"

namespace lodestone {

inline bool inside(const Bounding_sphere& ball, const Exact_point& p) {
  if (std::isinf(ball.radius)) return true;
  const CGAL::Exact_rational radius = ball.radius;
  return radius >= 0 && squared_distance(p, exact_point(ball.centre)) <= radius * radius;
}

}  // namespace lodestone
