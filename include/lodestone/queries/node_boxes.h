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
      boxes_ = fitted_boxes(*layout_.layout, layout_.coordinates);
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
