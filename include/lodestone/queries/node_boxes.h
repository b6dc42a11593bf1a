// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <vector>

#include "lodestone/tree/tree_view.h"

namespace lodestone {

/// Axis-aligned boxes of all nodes of a tree, for queries that need boxes whatever the tree's volumes are. A tree of
/// boxes lends its own: O(1). For any other, boxes are fitted to the vertices: O(V).
template <Bounding_volume Volume>
class Node_boxes {
 public:
  /// @param view  its tree must outlive this
  explicit Node_boxes(const Basic_tree_view<Volume>& view) : layout_(view) {
    if constexpr (!std::same_as<Volume, Aabb>) {
      const Tree_layout& tree = *layout_.layout;
      boxes_.resize(tree.node_count());
      fit_leaves(tree, layout_.coordinates, 0, tree.leaf_count(), std::span(boxes_));
      for (auto n = static_cast<std::uint32_t>(boxes_.size()); n-- > 0;)
        if (!tree.is_leaf(n)) boxes_[n].enclose(boxes_[n + 1], boxes_[tree.node(n).second_child]);
      layout_.boxes = boxes_;
    }
  }
  Node_boxes(const Node_boxes&) = delete;
  Node_boxes& operator=(const Node_boxes&) = delete;

  /// The tree's layout with boxes. Valid as long as this.
  const Layout_view& layout() const { return layout_; }

 private:
  std::vector<Aabb> boxes_;
  Layout_view layout_;
};

}  // namespace lodestone
