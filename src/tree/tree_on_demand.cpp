// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/tree_on_demand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lodestone/mesh/check_finite.h"
#include "lodestone/tree/region_tree.h"

namespace lodestone {

Tree_on_demand::Tree_on_demand(std::span<const Corners> corners, std::span<const Region_index> labels,
                               Coordinates coordinates, const Region_tree_options& options, Workers& workers) {
  Tree_layout layout(corners, labels, coordinates, options, workers);
  const auto anchors = find_anchors(layout, coordinates);
  *this = Tree_on_demand(std::move(layout), anchors, coordinates.size() / 3);
}

Tree_on_demand::Tree_on_demand(Tree_layout layout, std::span<const Node_anchor> anchors, std::size_t vertex_count)
    : layout_(std::move(layout)),
      posed_(layout_.leaf_count()),
      posed_below_(layout_.node_count()),
      boxes_(layout_.node_count()),
      vertex_count_(vertex_count) {
  nodes_.reserve(layout_.node_count());
  for (const auto& anchor : anchors)
    nodes_.push_back({.position = Eigen::Vector3d::Zero(), .radius = anchor.radius, .vertex = anchor.vertex});
}

void Tree_on_demand::save(State_writer& state) const {
  layout_.save(state);
  for (const Node& node : nodes_) {
    state.value(node.vertex);
    state.value(node.radius);
  }
}

Tree_on_demand Tree_on_demand::load(State_reader& state, std::span<const Corners> corners, std::size_t vertex_count) {
  Tree_layout layout = Tree_layout::load(state, corners, vertex_count);
  std::vector<Node_anchor> anchors(layout.node_count());
  for (auto& anchor : anchors) {
    anchor.vertex = state.value<std::uint32_t>();
    anchor.radius = state.finite();
    State_reader::require(anchor.vertex < vertex_count && anchor.radius >= 0, "a node has no anchor");
  }
  return {std::move(layout), anchors, vertex_count};
}

void Tree_on_demand::start_frame(const Live_positions& positions) {
  positions_ = positions;
  if (positions.memory() != nullptr) {
    coordinates_ = {positions.memory(), 3 * vertex_count_};
  } else {
    copied_.resize(3 * vertex_count_);
    coordinates_ = copied_;
  }
  ++frame_;
  vertices_read_ = 0;
  stretch_ = 1;
  bounded_ = false;
}

/// Where all faces probably are: bounds that seldom have to grow.
Aabb Tree_on_demand::guessed_bounds() {
  const Eigen::Vector3d& middle = anchor(0);
  Aabb bounds = {};
  for (int axis = 0; axis < 3; ++axis) {
    bounds.low[axis] = middle[axis] - 1.25 * radius(0);
    bounds.high[axis] = middle[axis] + 1.25 * radius(0);
  }
  return bounds;
}

void Tree_on_demand::read_anchor(Node& node) {
  node.position = positions_(node.vertex);
  if (!node.position.allFinite()) fail_not_finite(node.vertex);
  node.frame = frame_;
  ++vertices_read_;
}

/// Reads leaves none of which has been posed in this frame.
void Tree_on_demand::read_leaves(std::uint32_t first, std::uint32_t end) {
  if (positions_.memory() == nullptr)
    for (std::uint32_t leaf = first; leaf < end; ++leaf) copy_leaf(leaf);
  const Leaf_sums sums = fit_leaves(layout_, coordinates_, first, end, std::span(boxes_));
  // Finite coordinates can have a sum that overflows.
  if (!std::isfinite(sums.coordinates))
    for (std::uint32_t leaf = first; leaf < end; ++leaf)
      for (const auto vertex : layout_.vertices(leaf))
        if (!positions_(vertex).allFinite()) fail_not_finite(vertex);
  if (!std::exchange(bounded_, true)) bounds_ = guessed_bounds();
  for (std::uint32_t leaf = first; leaf < end; ++leaf) {
    posed_[leaf] = frame_;
    vertices_read_ += layout_.vertices(leaf).size();
    bounds_.enclose(bounds_, boxes_[layout_.leaf_node(leaf)]);
  }
}

void Tree_on_demand::read_below(std::uint32_t n) {
  const std::uint32_t end = layout_.node(n).end_leaf;
  for (std::uint32_t leaf = layout_.node(n).leaf; leaf < end; ++leaf) {
    const std::uint32_t unread = leaf;
    while (leaf < end && posed_[leaf] != frame_) ++leaf;
    if (unread < leaf) read_leaves(unread, leaf);
  }
  for (std::uint32_t node = layout_.leaf_node(end - 1); node-- > n;)
    if (!layout_.is_leaf(node)) boxes_[node].enclose(boxes_[node + 1], boxes_[layout_.node(node).second_child]);
  posed_below_[n] = frame_;
}

void Tree_on_demand::copy_leaf(std::uint32_t leaf) {
  for (const auto vertex : layout_.vertices(leaf)) {
    const Eigen::Vector3d position = positions_(vertex);
    std::copy_n(position.data(), 3, copied_.data() + 3 * std::size_t{vertex});
  }
}

}  // namespace lodestone
