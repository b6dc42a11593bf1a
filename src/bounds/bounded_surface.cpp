// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/bounded_surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "lodestone/tree/region_tree.h"

namespace lodestone {

namespace {

/// With more than one in so many vertices posed, the rest is posed at once: in order it takes less time per vertex.
constexpr std::size_t many_posed = 7;

bool contains(const Aabb& outer, const Aabb& inner) {
  bool result = true;
  for (int axis = 0; axis < 3; ++axis)
    result &= (outer.low[axis] <= inner.low[axis]) & (inner.high[axis] <= outer.high[axis]);
  return result;
}

}  // namespace

Bounded_surface::Bounded_surface(const Tree_layout& layout, std::unique_ptr<const Posable> motion)
    : layout_(&layout),
      motion_(std::move(motion)),
      coordinates_(3 * std::size_t{motion_->vertex_count()}),
      boxes_(layout.node_count()),
      boxed_in_(layout.node_count(), 0),
      posed_in_(layout.leaf_count(), 0) {
  check_layout(layout, motion_->vertex_count());
  if (motion_->node_count() < layout.node_count()) throw Bad_argument("a bound was made for a tree of fewer nodes");
  start_frame();
}

void Bounded_surface::start_frame() {
  if (frame_ > 0 && pose_ == motion_->pose_number()) return;
  pose_ = motion_->pose_number();
  ++frame_;
  all_posed_ = false;
  violations_settled_ = 0;
  violations_ = nodes_bounded_ = leaves_posed_ = vertices_posed_ = 0;
}

void Bounded_surface::bound(std::uint32_t node) {
  boxes_[node] = motion_->box(node);
  boxed_in_[node] = frame_;
  ++nodes_bounded_;
}

void Bounded_surface::read(std::uint32_t leaf) {
  if (vertices_posed_ > layout_->all_vertices().size() / many_posed) return pose_all();
  const auto vertices = layout_->vertices(leaf);
  const std::uint32_t node = layout_->leaf_node(leaf);
  const Aabb promised = box(node), promised_whole = box(0);
  motion_->pose(vertices, coordinates_);
  check_finite(leaf);
  boxes_[node].enclose(layout_->leaf_faces(leaf, coordinates_));
  if (!contains(promised, boxes_[node]) || !contains(promised_whole, boxes_[node])) ++violations_;
  posed_in_[leaf] = frame_;
  vertices_posed_ += vertices.size();
  ++leaves_posed_;
}

/// Boxes from bounds that were in use until now are compared with the fitted ones.
void Bounded_surface::pose_all() {
  if (all_posed_) return;
  motion_->pose_all(coordinates_);
  if (!layout_->finite(coordinates_))
    for (std::uint32_t leaf = 0; leaf < layout_->leaf_count(); ++leaf) check_finite(leaf);
  const std::vector<Aabb> promised = boxes_;
  fit_leaves(*layout_, coordinates_, 0, layout_->leaf_count(), boxes_);
  for (auto node = static_cast<std::uint32_t>(layout_->node_count()); node-- > 0;) {
    if (!layout_->is_leaf(node)) boxes_[node].enclose(boxes_[node + 1], boxes_[layout_->node(node).second_child]);
    if (boxed_in_[node] == frame_ && !contains(promised[node], boxes_[node])) ++violations_;
  }
  std::ranges::fill(boxed_in_, frame_);
  std::ranges::fill(posed_in_, frame_);
  all_posed_ = true;
  leaves_posed_ = layout_->leaf_count();
  vertices_posed_ = layout_->vertex_begin().back();
}

void Bounded_surface::settle() {
  pose_all();
  violations_settled_ = violations_;
}

void Bounded_surface::check_finite(std::uint32_t leaf) const {
  for (const auto vertex : layout_->vertices(leaf))
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!std::isfinite(coordinates_[3 * std::size_t{vertex} + axis]))
        throw Bad_mesh("vertex " + std::to_string(vertex) + " has a coordinate that is not finite");
}

}  // namespace lodestone
