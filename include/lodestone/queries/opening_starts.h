// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/queries/leaf_pair_list.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Two nodes below which to search.
struct Opening_start {
  Node_pair nodes;  ///< of the first and of the second tree
  float order = 0;  ///< squared distance of their anchors, in squares of the sum of their radii
};

/// The pairs of nodes below which an Opening_search looks, and whether they may be read as a whole. Keeps its memory
/// from one search to the next.
class Opening_starts {
 public:
  /// Takes the starts of a search. No node may lie below another one of the same tree. O(starts x log starts + leaves
  /// below them, as long as these have at most `most` vertices).
  /// @param most  vertices of both trees that may be read as a whole, counted once for each leaf that lists them
  void begin(const Tree_layout& a, const Tree_layout& b, std::span<const Opening_start> starts, std::size_t most);

  /// The pairs.
  std::span<const Opening_start> pairs() const { return pairs_; }
  /// Whether the leaves below the nodes may be read as a whole.
  bool are_whole() const { return whole_; }
  /// Whether the starts may be read as a whole, and two leaves lie below the nodes of one of them. O(log starts).
  bool cover(Leaf_pair leaves) const;

 private:
  /// Of a leaf: the node of a start that it lies below.
  struct Mark {
    std::uint32_t search = 0;  ///< the search that this is of
    std::uint32_t node = 0;
  };
  /// Per leaf of the tree of this search, and of others before.
  using Marks = std::vector<Mark>;

  void start_search();
  std::size_t mark_below(Marks& marks, const Tree_layout& tree, std::uint32_t node, std::size_t most) const;

  std::vector<Opening_start> pairs_;
  std::vector<Node_pair> nodes_;  ///< of the pairs, sorted; only if they may be read as a whole
  Marks a_, b_;
  std::uint32_t search_ = 0;
  bool whole_ = true;
};

}  // namespace lodestone
