// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/median_split.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/scaled_positions.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

struct Part {
  std::span<std::uint32_t> vertices;
  Region_index label = 0;

  /// True if this part is split later than `other`.
  bool operator<(const Part& other) const {
    return vertices.size() < other.vertices.size() || (vertices.size() == other.vertices.size() && label > other.label);
  }
};

Eigen::Index longest_axis(const Positions& positions, std::span<const std::uint32_t> vertices) {
  Eigen::RowVector3d low = positions.row(vertices.front()), high = low;
  for (const auto v : vertices) {
    low = low.cwiseMin(positions.row(v));
    high = high.cwiseMax(positions.row(v));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

/// The lower half keeps the label. It is the larger one if the number of vertices is odd.
std::pair<Part, Part> halves(const Positions& positions, const Part& part, Region_index fresh_label) {
  const Eigen::Index axis = longest_axis(positions, part.vertices);
  const std::size_t half = (part.vertices.size() + 1) / 2;
  std::ranges::nth_element(part.vertices, part.vertices.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](auto v) { return std::pair(positions(v, axis), v); });
  return {{part.vertices.first(half), part.label}, {part.vertices.subspan(half), fresh_label}};
}

Labelling label_median_split(const Numbered_surface& surface, std::size_t regions) {
  // The sides of a bounding box must not overflow.
  const Positions positions = scaled_positions(surface.positions);
  std::vector<std::uint32_t> order(static_cast<std::size_t>(positions.rows()));
  std::iota(order.begin(), order.end(), 0);

  std::priority_queue<Part> parts;
  parts.push({order, 0});
  while (parts.size() < regions && parts.top().vertices.size() > 1) {
    const auto [lower, upper] = halves(positions, parts.top(), static_cast<Region_index>(parts.size()));
    parts.pop();
    parts.push(lower);
    parts.push(upper);
  }

  Labelling labelling{.labels = std::vector<Region_index>(order.size())};
  for (; !parts.empty(); parts.pop())
    for (const auto v : parts.top().vertices) labelling.labels[v] = parts.top().label;
  return labelling;
}

}  // namespace

Labelling Median_split::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, label_median_split);
}

}  // namespace lodestone
