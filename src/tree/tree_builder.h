// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Makes the nodes and leaves of a Tree_layout.
class Tree_builder {
 public:
  Tree_builder(Tree_layout& tree, std::span<const Corners> corners, std::span<const Region_index> labels,
               Coordinates coordinates, const Region_tree_options& options)
      : tree_(tree), corners_(corners), labels_(labels), coordinates_(coordinates), options_(options) {}

  void build();

 private:
  /// What a split distributes: a face with the mean of its corners, or a region with the mean of its faces' centres.
  struct Item {
    Eigen::Vector3d centre;
    std::uint32_t index;
  };

  std::vector<Item> face_items() const;
  Region_index region_of(std::uint32_t face) const;
  void group_by_region(const std::vector<Item>& faces);
  void add_regions(std::span<Item> regions);
  void add_faces(std::span<Item> faces);
  void add_leaf(std::span<Item> faces);
  /// Adds a node and its two children. Each call of `add` adds a child: the first with the first `first_count` items
  /// along the axis on which the centres are spread widest, the second with the others.
  template <class Add>
  void add_parts(std::span<Item> items, std::size_t first_count, Add add);

  Tree_layout& tree_;
  std::span<const Corners> corners_;
  std::span<const Region_index> labels_;
  Coordinates coordinates_;
  const Region_tree_options& options_;
  std::vector<Item> faces_;                  ///< by region
  std::vector<std::uint32_t> region_begin_;  ///< per region and past the last: where it starts in `faces_`
};

}  // namespace lodestone
