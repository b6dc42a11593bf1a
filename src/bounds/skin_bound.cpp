// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/skin_bound.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "bounds/node_lists.h"
#include "lodestone/bounds/motion_bound.h"

namespace lodestone {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// One joint of a node, along one axis.
struct Weighted_end {
  double least, greatest;  ///< weights
  double end;              ///< M_j
};

/// max sum_j w_j M_j: the weight that is not yet given away goes to the greatest ends first.
double greatest_mean(std::span<Weighted_end> ends) {
  std::ranges::sort(ends, std::greater(), &Weighted_end::end);
  double sum = 0, left = 1;
  for (const auto& joint : ends) {
    sum += joint.least * joint.end;
    left -= joint.least;
  }
  for (const auto& joint : ends) {
    if (left <= 0) return sum;
    const double given = std::min(joint.greatest - joint.least, left);
    sum += given * joint.end;
    left -= given;
  }
  // Weights are rounded, so a little can be left.
  return left > 0 ? sum + left * ends.front().end : sum;
}

}  // namespace

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
  if (points.shape().target_count() > 0) shape_.emplace(points.shape(), layout);
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

std::vector<Skin_bound::Range> Skin_bound::of_leaf(std::span<const std::uint32_t> vertices) const {
  auto influences = influences_on(*points_, vertices);
  std::ranges::stable_sort(influences, {}, &Influence::joint);
  std::vector<Range> ranges;
  for (auto first = influences.begin(); first != influences.end();) {
    const auto end = std::ranges::upper_bound(first, influences.end(), first->joint, {}, &Influence::joint);
    const bool moves_all = static_cast<std::size_t>(end - first) == vertices.size();
    Range range = of_vertex(*first);
    for (auto other = first + 1; other != end; ++other) enclose(range, of_vertex(*other));
    if (!moves_all) range.least = 0;
    ranges.push_back(range);
    first = end;
  }
  return ranges;
}

Skin_bound::Range Skin_bound::of_vertex(const Influence& influence) const {
  const auto rest = points_->shape().rest().subspan(3 * std::size_t{influence.vertex}, 3);
  return {.joint = influence.joint,
          .least = influence.weight,
          .greatest = influence.weight,
          .low = {rest[0], rest[1], rest[2]},
          .high = {rest[0], rest[1], rest[2]}};
}

void Skin_bound::enclose(Range& range, const Range& other) {
  range.least = std::min(range.least, other.least);
  range.greatest = std::max(range.greatest, other.greatest);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    range.low[axis] = std::min(range.low[axis], other.low[axis]);
    range.high[axis] = std::max(range.high[axis], other.high[axis]);
  }
}

/// The vertices of two nodes together.
std::vector<Skin_bound::Range> Skin_bound::merged(std::span<const Range> a, std::span<const Range> b) {
  return merged_lists(
      a, b, [](const Range& range) { return range.joint; }, [](Range& range) { range.least = 0; }, enclose);
}

/// The box that a joint moves, widened by what morphing adds.
Skin_bound::Rest_box Skin_bound::widened(const Range& range, const Linear_bound::Shift& shift) {
  Rest_box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from = range.low[axis] + shift.low[axis] - shift.margin[axis];
    const double to = range.high[axis] + shift.high[axis] + shift.margin[axis];
    box.centre[axis] = from / 2 + to / 2;
    box.half[axis] = to / 2 - from / 2 + 0x1p-1073;  // halves of the smallest numbers are rounded
  }
  return box;
}

/// Where a joint takes a box, along one axis.
Skin_bound::Moved_box Skin_bound::moved(const Rest_box& box, const double* columns, std::size_t axis) {
  const double translation = columns[12 + axis];
  Moved_box moved{.middle = translation, .half = 0, .magnitude = std::abs(translation)};
  for (std::size_t column = 0; column < 3; ++column) {
    const double factor = columns[4 * column + axis];
    moved.middle += factor * box.centre[column];
    moved.half += std::abs(factor) * box.half[column];
    moved.magnitude += std::abs(factor) * (std::abs(box.centre[column]) + box.half[column]);
  }
  return moved;
}

Aabb Skin_bound::box(std::uint32_t node) const {
  const auto ranges = std::span(ranges_).subspan(range_begin_[node], range_begin_[node + 1] - range_begin_[node]);
  const Linear_bound::Shift shift = shape_ ? shape_->shift(node) : Linear_bound::Shift();
  boost::container::small_vector<Weighted_end, 16> low[3], high[3];
  double magnitude[3] = {0, 0, 0};  // R
  double size = 1;                  // |x| + |y| + |z| + 1
  for (const Range& range : ranges) {
    const Rest_box rest = widened(range, shift);
    double rest_size = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) rest_size += std::abs(rest.centre[axis]) + rest.half[axis];
    size = std::max(size, rest_size);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Moved_box there = moved(rest, points_->columns(range.joint), axis);
      high[axis].push_back({range.least, range.greatest, there.middle + there.half});
      low[axis].push_back({range.least, range.greatest, there.half - there.middle});  // mirrored
      // Not std::max alone, which leaves out what is no number.
      magnitude[axis] = std::isfinite(there.magnitude) ? std::max(magnitude[axis], there.magnitude) : infinite;
    }
  }
  const auto count = static_cast<double>(ranges.size() + most_influences_[node]);
  Aabb box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = -infinite, box.high[axis] = infinite;
    if (!std::isfinite(magnitude[axis])) continue;  // ends may be no numbers, which cannot be sorted
    const double margin = (16 * count + 64) * unit_roundoff * magnitude[axis] + (count + 4) * 0x1p-1070 * size;
    box.low[axis] = -greatest_mean({low[axis].data(), low[axis].size()}) - margin;
    box.high[axis] = greatest_mean({high[axis].data(), high[axis].size()}) + margin;
    open_if_not_finite(box, axis);
  }
  return box;
}

}  // namespace lodestone
