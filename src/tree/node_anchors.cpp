// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/node_anchors.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/to_box.h"

namespace lodestone {

namespace {

Eigen::Vector3d at(Coordinates coordinates, std::uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex});
}

/// Squared distance of a point from the box; never more than that of a vertex inside, since both round alike.
double squared_distance(const Eigen::Vector3d& point, const Aabb& box) {
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis)
    offset[axis] = std::max({0.0, box.low[axis] - point[axis], point[axis] - box.high[axis]});
  return offset.squaredNorm();
}

/// Squared distance of a point from the farthest corner of the box; never less than that of a vertex inside.
double largest_squared_distance(const Eigen::Vector3d& point, const Aabb& box) {
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis)
    offset[axis] = std::max(std::abs(box.low[axis] - point[axis]), std::abs(box.high[axis] - point[axis]));
  return offset.squaredNorm();
}

/// Finds the anchors of all nodes, from the leaves to the root. Above the leaves, the anchors of the two children bound
/// the distances, and only the parts of the tree are read whose boxes these bounds leave open.
class Anchor_search {
 public:
  Anchor_search(const Tree_layout& layout, Coordinates coordinates)
      : layout_(layout), coordinates_(coordinates), boxes_(layout.node_count()), anchors_(layout.node_count()) {}

  std::vector<Node_anchor> run() {
    for (auto n = static_cast<std::uint32_t>(layout_.node_count()); n-- > 0;) find(n);
    return std::move(anchors_);
  }

 private:
  void find(std::uint32_t n);
  void find_nearest(std::uint32_t n);
  void find_farthest(std::uint32_t n);
  double squared_distance_to(std::uint32_t vertex) const { return (at(coordinates_, vertex) - from_).squaredNorm(); }

  const Tree_layout& layout_;
  Coordinates coordinates_;
  std::vector<Aabb> boxes_;
  std::vector<Node_anchor> anchors_;

  // Of the search under way.
  Eigen::Vector3d from_;
  std::uint32_t vertex_ = 0;  ///< the nearest so far
  double nearest_ = 0;        ///< its squared distance
  double bound_ = 0;          ///< squared; the nearest is not farther away
  double farthest_ = 0;       ///< largest squared distance so far
};

void Anchor_search::find(std::uint32_t n) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool leaf = layout_.is_leaf(n);
  const std::uint32_t first = n + 1, second = layout_.node(n).second_child;
  if (leaf)
    boxes_[n].enclose(layout_.leaf_faces(layout_.node(n).leaf, coordinates_));
  else
    boxes_[n].enclose(boxes_[first], boxes_[second]);

  from_ = centre_of(boxes_[n]);
  nearest_ = infinity;
  bound_ = leaf ? infinity
                : std::min(squared_distance_to(anchors_[first].vertex), squared_distance_to(anchors_[second].vertex));
  find_nearest(n);

  from_ = at(coordinates_, vertex_);
  farthest_ = 0;
  find_farthest(n);
  // Longer, so that rounding does not part surfaces that touch where their radii end.
  constexpr double rounding = 1 + 1e-9;
  anchors_[n] = {.vertex = vertex_, .radius = rounding * std::sqrt(farthest_)};
}

/// Of several equally near the first one, in the order of the leaves.
void Anchor_search::find_nearest(std::uint32_t n) {
  if (squared_distance(from_, boxes_[n]) > bound_) return;
  if (!layout_.is_leaf(n)) {
    find_nearest(n + 1);
    find_nearest(layout_.node(n).second_child);
    return;
  }
  for (const auto vertex : layout_.vertices(layout_.node(n).leaf)) {
    const double squared = squared_distance_to(vertex);
    if (squared < nearest_) nearest_ = squared, vertex_ = vertex;
  }
  bound_ = std::min(bound_, nearest_);
}

void Anchor_search::find_farthest(std::uint32_t n) {
  if (largest_squared_distance(from_, boxes_[n]) <= farthest_) return;
  if (layout_.is_leaf(n)) {
    for (const auto vertex : layout_.vertices(layout_.node(n).leaf))
      farthest_ = std::max(farthest_, squared_distance_to(vertex));
    return;
  }
  std::uint32_t far = n + 1, near = layout_.node(n).second_child;
  if (largest_squared_distance(from_, boxes_[far]) < largest_squared_distance(from_, boxes_[near]))
    std::swap(far, near);
  find_farthest(far);
  find_farthest(near);
}

}  // namespace

std::vector<Node_anchor> find_anchors(const Tree_layout& layout, Coordinates coordinates) {
  return Anchor_search(layout, coordinates).run();
}

}  // namespace lodestone
