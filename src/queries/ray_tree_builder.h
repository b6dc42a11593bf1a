// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hwy/contrib/sort/vqsort.h>

#include <vector>

#include "lodestone/queries/ray_tree.h"

namespace lodestone {

/// Makes the nodes and blocks of a Ray_tree: the faces of each leaf of the surface's tree are packed into blocks, and
/// the binary nodes above them are joined into wide ones.
class Ray_tree_builder {
 public:
  explicit Ray_tree_builder(Ray_tree& tree) : tree_(tree), layout_(*tree.surface_.layout) {}

  void build(Workers& workers);

 private:
  /// A box in relative coordinates.
  struct Box {
    std::array<float, 3> low, high;

    void extend(const Box& other);
    float half_area() const;
  };
  /// A binary node: one of the layout, or some blocks of one leaf.
  struct Branch {
    Box box;
    std::uint32_t node;        ///< of the layout
    std::uint32_t first, end;  ///< its blocks

    std::size_t size() const { return end - first; }
  };
  /// A worker's memory: the faces of a leaf.
  struct Leaf_memory {
    std::vector<std::array<float, 3>> corners;  ///< three per face
    std::vector<std::array<float, 3>> sums;     ///< of the corners, per face
    std::array<float, 3> sums_low, sums_high;   ///< the box around the sums
    std::vector<std::uint32_t> order;           ///< the faces, as they are packed; their indices are in the low bits
    hwy::Sorter sort;
  };

  bool place();
  void count_blocks();
  void pack_leaf(std::uint32_t leaf, Leaf_memory& memory);
  void read_leaf(std::uint32_t leaf, Leaf_memory& memory) const;
  void add_block(std::uint32_t leaf, std::uint32_t block, std::span<const std::uint32_t> faces,
                 const Leaf_memory& memory);
  void fit_boxes();
  std::uint32_t add_node(const Branch& branch, std::size_t waiting);
  std::pair<Branch, Branch> children(const Branch& branch) const;
  Branch branch_of(std::uint32_t node) const;
  Branch branch_of(std::uint32_t node, std::uint32_t first, std::uint32_t end) const;
  std::array<float, 3> relative(const double* position) const;

  Ray_tree& tree_;
  const Tree_layout& layout_;
  std::vector<std::uint32_t> first_block_;  ///< per leaf and past the last
  std::vector<Box> block_boxes_;
  std::vector<Box> node_boxes_;  ///< of the layout
};

}  // namespace lodestone
