// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/skin_bound.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bounds/node_lists.h"

namespace lodestone {

namespace {

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
  struct Influence {
    std::uint32_t joint, vertex;
    double weight;
  };
  std::vector<Influence> influences;
  for (const auto vertex : vertices) {
    const auto [joints, weights] = points_->influences(vertex);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto same = std::ranges::find_if(
          influences, [&](const Influence& other) { return other.vertex == vertex && other.joint == joints[i]; });
      if (same != influences.end())
        same->weight += weights[i];
      else
        influences.push_back({joints[i], vertex, weights[i]});
    }
  }
  std::ranges::stable_sort(influences, {}, &Influence::joint);
  std::vector<Range> ranges;
  for (auto first = influences.begin(); first != influences.end();) {
    const auto end = std::ranges::upper_bound(first, influences.end(), first->joint, {}, &Influence::joint);
    const bool moves_all = static_cast<std::size_t>(end - first) == vertices.size();
    const double* rest = points_->shape().rest().data() + 3 * std::size_t{first->vertex};
    Range range{.joint = first->joint,
                .least = moves_all ? first->weight : 0,
                .greatest = first->weight,
                .low = {rest[0], rest[1], rest[2]},
                .high = {rest[0], rest[1], rest[2]}};
    for (; first != end; ++first) {
      range.least = std::min(range.least, first->weight);
      range.greatest = std::max(range.greatest, first->weight);
      rest = points_->shape().rest().data() + 3 * std::size_t{first->vertex};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        range.low[axis] = std::min(range.low[axis], rest[axis]);
        range.high[axis] = std::max(range.high[axis], rest[axis]);
      }
    }
    ranges.push_back(range);
  }
  return ranges;
}

/// The vertices of two nodes together.
std::vector<Skin_bound::Range> Skin_bound::merged(std::span<const Range> a, std::span<const Range> b) {
  return merged_lists(
      a, b, [](const Range& range) { return range.joint; }, [](Range& range) { range.least = 0; },
      [](Range& range, const Range& other) {
        range.least = std::min(range.least, other.least);
        range.greatest = std::max(range.greatest, other.greatest);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          range.low[axis] = std::min(range.low[axis], other.low[axis]);
          range.high[axis] = std::max(range.high[axis], other.high[axis]);
        }
      });
}

Aabb Skin_bound::box(std::uint32_t node) const {
  const auto ranges = std::span(ranges_).subspan(range_begin_[node], range_begin_[node + 1] - range_begin_[node]);
  const Linear_bound::Shift shift = shape_ ? shape_->shift(node) : Linear_bound::Shift();
  boost::container::small_vector<Weighted_end, 16> low[3], high[3];
  double reach[3] = {0, 0, 0};  // R
  double size = 1;              // |x| + |y| + |z| + 1
  for (const Range& range : ranges) {
    Eigen::Vector3d centre, half;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = range.low[axis] + shift.low[axis] - shift.margin[axis];
      const double to = range.high[axis] + shift.high[axis] + shift.margin[axis];
      const auto row = static_cast<Eigen::Index>(axis);
      centre[row] = from / 2 + to / 2;
      half[row] = to / 2 - from / 2 + 0x1p-1073;  // halves of the smallest numbers are rounded
    }
    size = std::max(size, 1 + centre.cwiseAbs().sum() + half.sum());
    const double* columns = points_->columns(range.joint);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double middle = columns[12 + axis], spread = 0, magnitude = std::abs(middle);
      for (std::size_t column = 0; column < 3; ++column) {
        const double factor = columns[4 * column + axis];
        const auto row = static_cast<Eigen::Index>(column);
        middle += factor * centre[row];
        spread += std::abs(factor) * half[row];
        magnitude += std::abs(factor) * (std::abs(centre[row]) + half[row]);
      }
      high[axis].push_back({range.least, range.greatest, middle + spread});
      low[axis].push_back({range.least, range.greatest, spread - middle});  // mirrored
      reach[axis] =
          std::isfinite(magnitude) ? std::max(reach[axis], magnitude) : std::numeric_limits<double>::infinity();
    }
  }
  const auto count = static_cast<double>(ranges.size() + most_influences_[node]);
  Aabb box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(reach[axis])) {  // ends may be no numbers, which cannot be sorted
      open_axis(box, axis);
      continue;
    }
    const double margin = (16 * count + 64) * unit_roundoff * reach[axis] + (count + 4) * 0x1p-1070 * size;
    box.low[axis] = -greatest_mean({low[axis].data(), low[axis].size()}) - margin;
    box.high[axis] = greatest_mean({high[axis].data(), high[axis].size()}) + margin;
    open_if_not_finite(box, axis);
  }
  return box;
}

}  // namespace lodestone
