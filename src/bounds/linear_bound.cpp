// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/linear_bound.h"

#include <algorithm>
#include <cmath>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/tree/region_tree.h"

namespace lodestone {

Linear_bound::Linear_bound(const Morphed_points& points, const Tree_layout& layout)
    : shifts_(points, layout), rest_(fitted_boxes(layout, points.rest())) {}

Aabb Linear_bound::box(std::uint32_t node) const {
  const Morph_shift by = shifts_[node];
  Aabb box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = rest_[node].low[axis], high = rest_[node].high[axis];
    const double margin = by.rounding * (std::max(std::abs(low), std::abs(high)) + by.magnitude[axis]) + by.underflow;
    box.low[axis] = low + by.low[axis] - margin;
    box.high[axis] = high + by.high[axis] + margin;
    open_if_not_finite(box, axis);
  }
  return box;
}

}  // namespace lodestone
