// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/queries/ray_tree.h"

namespace lodestone {

/// Makes the nodes and blocks of a Ray_tree: the faces of each leaf of the surface's tree are packed into blocks, and
/// the binary nodes above them are joined into wide ones. Takes them to another pose.
class Ray_tree_builder {
 public:
  explicit Ray_tree_builder(Ray_tree& tree) : tree_(tree), layout_(*tree.surface_.layout) {}

  void build(Workers& workers);
  /// Fits what has been built to the surface of the tree as it is now.
  void refit(Workers& workers);

 private:
  /// A binary node: one of the layout, or some blocks of one leaf.
  struct Branch {
    Ray_box box;
    std::uint32_t node;        ///< of the layout
    std::uint32_t first, end;  ///< its blocks

    std::size_t size() const { return end - first; }
  };
  /// A worker's memory: the faces of a leaf.
  struct Leaf_memory {
    std::vector<std::array<float, 3>> sums;  ///< of the corners, per face
    Ray_box around;                          ///< the sums
    std::vector<std::uint32_t> order;        ///< the faces, as they are packed; their indices are in the low bits
  };

  bool place();
  bool tells_leaves_apart() const;
  void count_blocks();
  void pack_leaf(std::uint32_t leaf, Leaf_memory& memory);
  void read_leaf(std::uint32_t leaf, Leaf_memory& memory) const;
  void add_block(std::uint32_t leaf, std::uint32_t block, std::span<const std::uint32_t> faces);
  void fit_blocks(std::size_t first, std::size_t end);
  void fit_boxes();
  std::uint32_t add_node(const Branch& branch, std::size_t waiting);
  std::pair<Branch, Branch> children(const Branch& branch) const;
  Branch branch_of(std::uint32_t node) const;
  Branch branch_of(std::uint32_t node, std::uint32_t first, std::uint32_t end) const;
  Ray_box around_blocks(std::uint32_t first, std::uint32_t end) const;
  std::array<float, 3> relative(const double* position) const;
  Ray_box refit_node(std::size_t index, std::span<const Ray_box> node_boxes);

  Ray_tree& tree_;
  const Tree_layout& layout_;
  std::vector<std::uint32_t> first_block_;  ///< per leaf and past the last
  std::vector<Ray_box> node_boxes_;         ///< of the layout
};

}  // namespace lodestone
