// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/linear_bound.h"

#include <algorithm>
#include <cmath>

#include "bounds/node_lists.h"
#include "lodestone/bounds/motion_bound.h"
#include "lodestone/tree/region_tree.h"

namespace lodestone {

Linear_bound::Linear_bound(const Morphed_points& points, const Tree_layout& layout) : points_(&points) {
  check_layout(layout, points.vertex_count());
  rest_ = fitted_boxes(layout, points.rest());
  node_lists(
      layout, [&](auto vertices) { return of_leaf(vertices); }, merged, ranges_, range_begin_);
}

/// Vertices that a target leaves alone have the offset 0.
std::vector<Linear_bound::Range> Linear_bound::of_leaf(std::span<const std::uint32_t> vertices) const {
  struct Offset {
    std::uint32_t target;
    std::span<const double, 3> by;
  };
  std::vector<Offset> offsets;
  for (const auto vertex : vertices)
    points_->for_each_offset(vertex, [&](std::uint32_t target, std::span<const double, 3> by) {
      offsets.push_back({target, by});
    });
  std::ranges::stable_sort(offsets, {}, &Offset::target);
  std::vector<Range> ranges;
  for (auto first = offsets.begin(); first != offsets.end();) {
    const auto end = std::ranges::upper_bound(first, offsets.end(), first->target, {}, &Offset::target);
    Range range{.target = first->target, .low = {}, .high = {}};
    if (static_cast<std::size_t>(end - first) == vertices.size()) std::ranges::copy(first->by, range.low.begin());
    range.high = range.low;
    for (; first != end; ++first)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        range.low[axis] = std::min(range.low[axis], first->by[axis]);
        range.high[axis] = std::max(range.high[axis], first->by[axis]);
      }
    ranges.push_back(range);
  }
  return ranges;
}

/// The vertices of two nodes together.
std::vector<Linear_bound::Range> Linear_bound::merged(std::span<const Range> a, std::span<const Range> b) {
  return merged_lists(
      a, b, [](const Range& range) { return range.target; },
      [](Range& range) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          range.low[axis] = std::min(range.low[axis], 0.0);
          range.high[axis] = std::max(range.high[axis], 0.0);
        }
      },
      [](Range& range, const Range& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          range.low[axis] = std::min(range.low[axis], other.low[axis]);
          range.high[axis] = std::max(range.high[axis], other.high[axis]);
        }
      });
}

Linear_bound::Shift Linear_bound::shift(std::uint32_t node) const {
  Shift shift;
  std::array<double, 3> magnitude;
  for (std::size_t axis = 0; axis < 3; ++axis)
    magnitude[axis] = std::max(std::abs(rest_[node].low[axis]), std::abs(rest_[node].high[axis]));
  std::size_t terms = 0;
  for (std::uint64_t i = range_begin_[node]; i < range_begin_[node + 1]; ++i) {
    const Range& range = ranges_[i];
    const double weight = points_->weights()[range.target];
    if (weight == 0) continue;
    ++terms;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double one = weight * range.low[axis], other = weight * range.high[axis];
      shift.low[axis] += std::min(one, other);
      shift.high[axis] += std::max(one, other);
      magnitude[axis] += std::max(std::abs(one), std::abs(other));
    }
  }
  if (terms == 0) return shift;  // the position is not rounded
  const auto count = static_cast<double>(terms);
  for (std::size_t axis = 0; axis < 3; ++axis)
    shift.margin[axis] = (4 * count + 16) * unit_roundoff * magnitude[axis] + count * 0x1p-1020;
  return shift;
}

Aabb Linear_bound::box(std::uint32_t node) const {
  const Shift by = shift(node);
  Aabb box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = rest_[node].low[axis] + by.low[axis] - by.margin[axis];
    box.high[axis] = rest_[node].high[axis] + by.high[axis] + by.margin[axis];
    open_if_not_finite(box, axis);
  }
  return box;
}

}  // namespace lodestone
