// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/slab_membership.h"

namespace lodestone {

bool within(double low, const Rational& value, double high) {
  const bool above = low == -INFINITY || (std::isfinite(low) && Rational(low) <= value);
  const bool below = high == INFINITY || (std::isfinite(high) && value <= Rational(high));
  return above && below;
}

bool inside(const Aabb& box, const Exact_point& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (!within(box.low[axis], p[axis], box.high[axis])) return false;
  return true;
}

bool inside(const Oriented_box& box, const Exact_point& p) {
  const Exact_vector from_centre = p - exact_point(box.centre);
  for (int i = 0; i < 3; ++i) {
    const Exact_vector axis(box.axes[i][0], box.axes[i][1], box.axes[i][2]);
    if (!within(-box.half[i], axis * from_centre, box.half[i])) return false;
  }
  return true;
}

bool inside(const Quospo& volume, const Exact_point& p) {
  const auto directions = volume.turn.directions();
  for (int i = 0; i < 3; ++i) {
    const auto& d = directions[i];
    if (!within(volume.low[i], p[i], volume.high[i])) return false;
    if (!within(volume.turned_low[i], d[0] * p.x() + d[1] * p.y() + d[2] * p.z(), volume.turned_high[i])) return false;
  }
  return true;
}

}  // namespace lodestone
