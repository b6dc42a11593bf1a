// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lodestone/tree/region_tree.h"

namespace lodestone {

/// Two nodes by index, of two trees or of one.
struct Node_pair {
  std::uint32_t a = 0;  ///< of the first tree
  std::uint32_t b = 0;  ///< of the second tree
};

/// The two roots.
inline constexpr Node_pair root_pair{0, 0};

/// What lies one level below a node pair, not both leaves: the two children of one node, each with the other node. The
/// pair to be visited first comes first.
inline std::array<Node_pair, 2> pairs_below(const Tree_layout& a, const Tree_layout& b, Node_pair pair,
                                            bool a_is_larger) {
  const bool open_a = b.is_leaf(pair.b) || (!a.is_leaf(pair.a) && a_is_larger);
  if (open_a) return {{{pair.a + 1, pair.b}, {a.node(pair.a).second_child, pair.b}}};
  return {{{pair.a, pair.b + 1}, {pair.a, b.node(pair.b).second_child}}};
}

/// Pushes what lies one level below a node pair, not both leaves. The pair to be visited first is pushed last.
inline void open_pair(const Tree_layout& a, const Tree_layout& b, Node_pair pair, bool a_is_larger,
                      std::vector<Node_pair>& stack) {
  const auto [first, second] = pairs_below(a, b, pair, a_is_larger);
  stack.push_back(second);
  stack.push_back(first);
}

/// Opens the node with the larger volume, since that separates most.
template <Bounding_volume Volume>
void open_pair(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b, Node_pair pair,
               std::vector<Node_pair>& stack) {
  open_pair(a, b, pair, a.volume(pair.a).extent() >= b.volume(pair.b).extent(), stack);
}

/// Pushes what lies one level below a node, no leaf, paired with itself: each child with itself, and the two children
/// with each other. The pair to be visited first is pushed last.
inline void open_with_itself(const Tree_layout& tree, std::uint32_t n, std::vector<Node_pair>& stack) {
  const std::uint32_t first = n + 1, second = tree.node(n).second_child;
  stack.push_back({second, second});
  stack.push_back({first, second});
  stack.push_back({first, first});
}

}  // namespace lodestone
