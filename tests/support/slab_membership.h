// SPDX-License-Identifier: GPL-3.0-or-later
// Which points are in volumes bounded by planes, decided exactly.
#pragma once

#include <cmath>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/k_dop.h"
#include "lodestone/volumes/oriented_box.h"
#include "lodestone/volumes/quospo.h"
#include "support/exact_point.h"

namespace lodestone {

/// low <= value <= high, where limits may be infinite.
bool within(double low, const Rational& value, double high);

bool inside(const Aabb& box, const Exact_point& p);

template <int K>
bool inside(const K_dop<K>& dop, const Exact_point& p) {
  for (int i = 0; i < dop.slabs; ++i) {
    const auto& d = dop.directions[i];
    if (!within(dop.low[i], d[0] * p.x() + d[1] * p.y() + d[2] * p.z(), dop.high[i])) return false;
  }
  return true;
}

bool inside(const Oriented_box& box, const Exact_point& p);

bool inside(const Quospo& volume, const Exact_point& p);

}  // namespace lodestone
