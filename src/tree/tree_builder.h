// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "lodestone/mesh/workers.h"
#include "lodestone/tree/tree_layout.h"
#include "tree/face_split.h"
#include "tree/leaf_numbering.h"

namespace lodestone {

/// Makes the nodes and leaves of a Tree_layout.
///
/// How many leaves each branch has is known before it is split. So every node, leaf and face has its index in the lists
/// of the tree from the start, and branches can be made in any order, by several threads.
class Tree_builder {
 public:
  Tree_builder(Tree_layout& tree, std::span<const Corners> corners, std::span<const Region_index> labels,
               Coordinates coordinates, const Region_tree_options& options, Workers& workers)
      : tree_(tree),
        corners_(corners),
        labels_(labels),
        coordinates_(coordinates),
        leaf_faces_(options.leaf_faces),
        workers_(workers) {}

  void build();

 protected:
  /// A node to be made, and all that comes below it.
  struct Branch {
    std::uint32_t begin = 0, end = 0;  ///< its faces, as a range of `items_` or `spare_`
    bool in_spare = false;
    std::uint32_t leaves = 0;                    ///< how many; 1: the node is one
    std::uint32_t node = 0, leaf = 0, face = 0;  ///< indices in the tree's lists; of leaf and face, the first
  };
  void make_room(std::size_t faces);
  void read_items();
  void read_again(std::span<Split_item> items, Workers& workers) const;
  void group_by_region();
  void size_lists(std::size_t leaves);
  std::vector<Split_item> region_items() const;
  void add_regions(std::span<Split_item> regions, std::span<Split_item> spare, const Branch& whole,
                   std::vector<Branch>& branches);
  void add_branches(std::vector<Branch> branches);
  void add_branch(const Branch& branch, Leaf_numbering& numbers);
  std::pair<Branch, Branch> halve(const Branch& branch, Workers& workers = Workers::alone());
  std::pair<Branch, Branch> add_inner_node(const Branch& branch, std::uint32_t first_faces, std::uint32_t first_leaves);
  void add_leaf(const Branch& branch, Leaf_numbering& numbers);
  void add_leaf_node(const Branch& branch, std::size_t vertex_count);
  void size_vertices();
  void gather_vertices(std::size_t first_leaf, std::size_t end_leaf);

  std::uint32_t faces_of(Region_index region) const { return region_begin_[region + 1] - region_begin_[region]; }
  /// As few as possible, of nearly equal size: plain halving would fill them anywhere between half and whole.
  std::uint32_t leaves_for(std::size_t faces) const {
    return static_cast<std::uint32_t>((faces + leaf_faces_ - 1) / leaf_faces_);
  }

  Tree_layout& tree_;
  std::span<const Corners> corners_;
  std::span<const Region_index> labels_;
  Coordinates coordinates_;
  std::size_t leaf_faces_;
  Workers& workers_;
  Unset_vector<Split_item> items_, spare_;   ///< per face to be grouped; a branch lies in one of the two
  Unset_vector<std::uint32_t> vertices_;     ///< of each leaf, from three times the index of its first item
  std::vector<std::uint32_t> item_begin_;    ///< per leaf that is made here: where its items start
  std::vector<std::uint32_t> region_begin_;  ///< per region and past the last: where its faces start in `items_`
};

}  // namespace lodestone
