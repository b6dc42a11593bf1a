// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/skin_bound.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>

#include "bounds/node_lists.h"
#include "bounds/skin_box_kernel.h"
#include "lodestone/bounds/motion_bound.h"

namespace lodestone {

/// The influences on some vertices, one for each joint and vertex: weights of a joint that a vertex lists again add up.
std::vector<Skin_bound::Influence> Skin_bound::influences_on(const Skinned_points& points,
                                                             std::span<const std::uint32_t> vertices) {
  std::vector<Influence> influences;
  for (const auto vertex : vertices) {
    const auto [joints, weights] = points.influences(vertex);
    const auto of_vertex = static_cast<std::ptrdiff_t>(influences.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto again =
          std::ranges::find(influences.begin() + of_vertex, influences.end(), joints[i], &Influence::joint);
      if (again != influences.end())
        again->weight += weights[i];
      else
        influences.push_back({joints[i], vertex, weights[i]});
    }
  }
  return influences;
}

Skin_bound::Skin_bound(const Skinned_points& points, const Tree_layout& layout) : points_(&points) {
  check_layout(layout, points.vertex_count());
  if (points.shape().target_count() > 0) shifts_.emplace(points.shape(), layout);
  node_lists(
      layout, [&](auto vertices) { return of_leaf(vertices); }, merged, ranges_, range_begin_);
  most_influences_.resize(layout.node_count(), 0);
  for (auto node = static_cast<std::uint32_t>(layout.node_count()); node-- > 0;) {
    auto& most = most_influences_[node];
    if (layout.is_leaf(node))
      for (const auto vertex : layout.vertices(layout.node(node).leaf))
        most = std::max(most, static_cast<std::uint32_t>(points.influences(vertex).joints.size()));
    else
      most = std::max(most_influences_[node + 1], most_influences_[layout.node(node).second_child]);
  }
}

std::vector<Joint_range> Skin_bound::of_leaf(std::span<const std::uint32_t> vertices) const {
  auto influences = influences_on(*points_, vertices);
  std::ranges::stable_sort(influences, {}, &Influence::joint);
  std::vector<Joint_range> ranges;
  for (auto first = influences.begin(); first != influences.end();) {
    const auto end = std::ranges::upper_bound(first, influences.end(), first->joint, {}, &Influence::joint);
    const bool moves_all = static_cast<std::size_t>(end - first) == vertices.size();
    Joint_range range = of_vertex(*first);
    for (auto other = first + 1; other != end; ++other) enclose(range, of_vertex(*other));
    if (!moves_all) range.least = 0;
    ranges.push_back(range);
    first = end;
  }
  return ranges;
}

Joint_range Skin_bound::of_vertex(const Influence& influence) const {
  const auto rest = points_->shape().rest().subspan(3 * std::size_t{influence.vertex}, 3);
  return {.low = {rest[0], rest[1], rest[2]},
          .high = {rest[0], rest[1], rest[2]},
          .least = influence.weight,
          .greatest = influence.weight,
          .joint = influence.joint};
}

void Skin_bound::enclose(Joint_range& range, const Joint_range& other) {
  range.least = std::min(range.least, other.least);
  range.greatest = std::max(range.greatest, other.greatest);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    range.low[axis] = std::min(range.low[axis], other.low[axis]);
    range.high[axis] = std::max(range.high[axis], other.high[axis]);
  }
}

/// The vertices of two nodes together.
std::vector<Joint_range> Skin_bound::merged(std::span<const Joint_range> a, std::span<const Joint_range> b) {
  return merged_lists(
      a, b, [](const Joint_range& range) { return range.joint; }, [](Joint_range& range) { range.least = 0; }, enclose);
}

Aabb Skin_bound::box(std::uint32_t node) const {
  const auto ranges = std::span(ranges_).subspan(range_begin_[node], range_begin_[node + 1] - range_begin_[node]);
  boost::container::small_vector<kernel::Moved_range, 16> memory(ranges.size(), boost::container::default_init);
  Aabb box = kernel::skin_box({.ranges = ranges.data(),
                               .joint_count = ranges.size(),
                               .most_influences = most_influences_[node],
                               .columns = points_->columns(0),
                               .shift = shifts_ ? (*shifts_)[node] : Morph_shift()},
                              memory.data());
  for (std::size_t axis = 0; axis < 3; ++axis) open_if_not_finite(box, axis);
  return box;
}

}  // namespace lodestone
