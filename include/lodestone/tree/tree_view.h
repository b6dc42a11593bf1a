// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <span>

#include "lodestone/tree/region_tree.h"

namespace lodestone {

/// A layout with the coordinates of its vertices: what filters and queries read, whatever volumes the tree has.
struct Layout_view {
  const Tree_layout* layout = nullptr;  ///< how the faces are grouped
  Coordinates coordinates = {};         ///< of the vertices, 3 V
  Aabb bounds = {};                     ///< encloses all faces, not always tightly
  std::span<const Aabb> boxes = {};     ///< per node; empty: the tree has volumes of another kind

  /// The faces of a leaf.
  Leaf_faces leaf(std::uint32_t index) const { return layout->leaf_faces(index, coordinates); }
};

/// A tree with the coordinates that it was refitted to.
template <Bounding_volume Volume>
struct Basic_tree_view {
  const Basic_region_tree<Volume>* tree = nullptr;  ///< with volumes
  Coordinates coordinates = {};                     ///< 3 V

  /// The same without the volumes; trees of boxes lend theirs.
  operator Layout_view() const {
    if constexpr (std::same_as<Volume, Aabb>)
      return {tree, coordinates, tree->volume(0), tree->volumes()};
    else
      return {tree, coordinates, tree->volume(0).bounds()};
  }
};
using Tree_view = Basic_tree_view<Aabb>;  ///< a tree of boxes with its coordinates

}  // namespace lodestone
