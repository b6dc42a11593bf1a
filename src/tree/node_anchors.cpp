// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/node_anchors.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lodestone/volumes/aabb.h"

namespace lodestone {

namespace {

Eigen::Vector3d at(Coordinates coordinates, std::uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex});
}

/// The vertices of a node's leaves: those at the border of two leaves twice.
std::span<const std::uint32_t> vertices_below(const Tree_layout& layout, const Tree_layout::Node& node) {
  const auto begin = layout.vertex_begin();
  return layout.all_vertices().subspan(begin[node.leaf], begin[node.end_leaf] - begin[node.leaf]);
}

Eigen::Vector3d centre(const Aabb& box) {
  // Halved first, since the sum may overflow.
  return {box.low[0] / 2 + box.high[0] / 2, box.low[1] / 2 + box.high[1] / 2, box.low[2] / 2 + box.high[2] / 2};
}

Node_anchor find_anchor(std::span<const std::uint32_t> vertices, Coordinates coordinates,
                        const Eigen::Vector3d& centre) {
  Node_anchor anchor{.vertex = vertices.front()};
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const auto vertex : vertices) {
    const double squared = (at(coordinates, vertex) - centre).squaredNorm();
    if (squared < nearest) nearest = squared, anchor.vertex = vertex;
  }
  const Eigen::Vector3d position = at(coordinates, anchor.vertex);
  for (const auto vertex : vertices) farthest = std::max(farthest, (at(coordinates, vertex) - position).squaredNorm());
  // Longer, so that rounding does not part surfaces that touch where their radii end.
  constexpr double rounding = 1 + 1e-9;
  anchor.radius = rounding * std::sqrt(farthest);
  return anchor;
}

}  // namespace

std::vector<Node_anchor> find_anchors(const Tree_layout& layout, Coordinates coordinates) {
  std::vector<Node_anchor> anchors(layout.node_count());
  std::vector<Aabb> boxes(layout.node_count());
  for (auto n = static_cast<std::uint32_t>(layout.node_count()); n-- > 0;) {
    if (layout.is_leaf(n))
      boxes[n].enclose(layout.leaf_faces(layout.node(n).leaf, coordinates));
    else
      boxes[n].enclose(boxes[n + 1], boxes[layout.node(n).second_child]);
    anchors[n] = find_anchor(vertices_below(layout, layout.node(n)), coordinates, centre(boxes[n]));
  }
  return anchors;
}

}  // namespace lodestone
