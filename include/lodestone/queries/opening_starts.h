// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/tree_on_demand.h"

namespace lodestone {

/// Two nodes below which to search.
struct Opening_start {
  Node_pair nodes;  ///< of the first and of the second tree
  float order = 0;  ///< squared distance of their anchors, relative to the sum of their radii
};

/// A leaf of each of two trees.
struct Leaf_pair {
  std::uint32_t a;  ///< of the first
  std::uint32_t b;  ///< of the second

  /// By the first leaf, then by the second.
  friend auto operator<=>(const Leaf_pair&, const Leaf_pair&) = default;
};

/// The pairs of nodes below which an Opening_search looks, and whether they may be read as a whole. Keeps its memory
/// from one search to the next.
class Opening_starts {
 public:
  /// Takes the starts of a search. No node may lie below another one of the same tree. O(starts x depth + leaves below
  /// them), of which hardly more are looked at than have `most` vertices.
  /// @param most  vertices of both trees that may be read as a whole
  void begin(const Tree_on_demand& a, const Tree_on_demand& b, std::span<const Opening_start> starts, std::size_t most);

  /// The pairs.
  std::span<const Opening_start> pairs() const { return pairs_; }
  /// Whether the leaves below the nodes may be read as a whole.
  bool are_whole() const { return whole_; }
  /// Whether the starts may be read as a whole, and two leaves lie below the nodes of one of them. O(1).
  bool cover(Leaf_pair leaves) const {
    if (!whole_) return false;
    const Place a = a_.leaves[leaves.a], b = b_.leaves[leaves.b];
    return a.search == search_ && b.search == search_ && is_start_[std::size_t{a.node} * b_.nodes + b.node] != 0;
  }

 private:
  /// Of a leaf: below which of the nodes of its tree it lies.
  struct Place {
    std::uint32_t search = 0;  ///< the search that this is of
    std::uint32_t node = 0;    ///< counted in the order in which nodes come first
  };
  /// The nodes of one tree.
  struct Side {
    std::vector<Place> leaves;  ///< of the tree of this search, and others before
    std::size_t nodes = 0;      ///< different ones
    std::size_t vertices = 0;   ///< below them
  };

  void start_search();
  std::uint32_t place(Side& side, const Tree_on_demand& tree, std::uint32_t node) const;

  std::vector<Opening_start> pairs_;
  std::vector<Node_pair> places_;  ///< parallel: of their nodes
  std::vector<char> is_start_;     ///< per node of a, per node of b
  Side a_, b_;
  std::uint32_t search_ = 0;
  bool whole_ = true;
};

}  // namespace lodestone
