// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/morph_shifts.h"

#include <algorithm>
#include <cstddef>

#include "bounds/node_lists.h"
#include "bounds/offset_kernel.h"
#include "lodestone/bounds/motion_bound.h"

namespace lodestone {

Morph_shifts::Morph_shifts(const Morphed_points& points, const Tree_layout& layout) : points_(&points) {
  check_layout(layout, points.vertex_count());
  node_lists(
      layout, [&](auto vertices) { return of_leaf(vertices); }, merged, ranges_, range_begin_);
}

/// Vertices that a target leaves alone have the offset 0.
std::vector<Offset_range> Morph_shifts::of_leaf(std::span<const std::uint32_t> vertices) const {
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
  std::vector<Offset_range> ranges;
  for (auto first = offsets.begin(); first != offsets.end();) {
    const auto end = std::ranges::upper_bound(first, offsets.end(), first->target, {}, &Offset::target);
    Offset_range range{.target = first->target};
    if (static_cast<std::size_t>(end - first) == vertices.size())
      for (std::size_t axis = 0; axis < 3; ++axis) range.low[axis] = range.high[axis] = first->by[axis];
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
std::vector<Offset_range> Morph_shifts::merged(std::span<const Offset_range> a, std::span<const Offset_range> b) {
  return merged_lists(
      a, b, [](const Offset_range& range) { return range.target; },
      [](Offset_range& range) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          range.low[axis] = std::min(range.low[axis], 0.0);
          range.high[axis] = std::max(range.high[axis], 0.0);
        }
      },
      [](Offset_range& range, const Offset_range& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          range.low[axis] = std::min(range.low[axis], other.low[axis]);
          range.high[axis] = std::max(range.high[axis], other.high[axis]);
        }
      });
}

Morph_shift Morph_shifts::operator[](std::uint32_t node) const {
  const auto ranges = std::span(ranges_).subspan(range_begin_[node], range_begin_[node + 1] - range_begin_[node]);
  return kernel::add_offsets(ranges, points_->weights().data());
}

}  // namespace lodestone
