// SPDX-License-Identifier: GPL-3.0-or-later
// Which points lie in a volume, decided exactly, for every model. One that is new needs an `inside` of its own.
#pragma once

#include "contact/volumes/ball_membership.h"
#include "contact/volumes/exact_point.h"
#include "contact/volumes/slab_membership.h"
#include "lodestone/contact/triangle_intersection.h"
#include "lodestone/contact/volumes/aabb.h"

namespace lodestone {

using Exact_number = CGAL::Exact_rational;

inline Exact_point exact(const Point& p) { return {p.x(), p.y(), p.z()}; }

inline bool inside(const Aabb& box, const Exact_point& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < Exact_number(box.low[axis]) || p[axis] > Exact_number(box.high[axis])) return false;
  return true;
}

}  // namespace lodestone
