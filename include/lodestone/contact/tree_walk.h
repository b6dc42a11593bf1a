// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lodestone/contact/region_tree.h"

namespace lodestone {

/// What a visitor wants after what it has been shown.
enum class Visit { go_on, stop };

/// Two nodes, of two trees or of one.
struct Node_pair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// Replaces a pair of near nodes, not both leaves, by the pairs below it, the last to be visited first: the larger
/// volume is opened, since that separates most.
inline void open_pair(const Tree_layout& a, const Tree_layout& b, Node_pair pair, bool a_is_larger,
                      std::vector<Node_pair>& ahead) {
  const bool open_a = b.is_leaf(pair.b) || (!a.is_leaf(pair.a) && a_is_larger);
  if (open_a) {
    ahead.push_back({a.node(pair.a).second_child, pair.b});
    ahead.push_back({pair.a + 1, pair.b});
  } else {
    ahead.push_back({pair.a, b.node(pair.b).second_child});
    ahead.push_back({pair.a, pair.b + 1});
  }
}

template <Bounding_volume Volume>
void open_pair(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b, Node_pair pair,
               std::vector<Node_pair>& ahead) {
  open_pair(a, b, pair, a.volume(pair.a).extent() >= b.volume(pair.b).extent(), ahead);
}

/// The same for a node against itself: its children against themselves and against each other.
inline void open_node(const Tree_layout& tree, std::uint32_t n, std::vector<Node_pair>& ahead) {
  const std::uint32_t first = n + 1, second = tree.node(n).second_child;
  ahead.push_back({second, second});
  ahead.push_back({first, second});
  ahead.push_back({first, first});
}

/// Visits the pairs of leaves whose volumes do not prove them farther apart than `margin`, below the nodes on the stack
/// `ahead`. The order depends on the volumes alone. After a stop what has not been visited is still on the stack.
///
/// @param visit  called with the numbers of a leaf of a and a leaf of b, returns a `Visit`
template <Bounding_volume Volume, class Visitor>
Visit walk_leaf_pairs(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b, double margin,
                      std::vector<Node_pair>& ahead, Visitor&& visit) {
  while (!ahead.empty()) {
    const Node_pair pair = ahead.back();
    ahead.pop_back();
    if (!near(a.volume(pair.a), b.volume(pair.b), margin)) continue;
    if (!a.is_leaf(pair.a) || !b.is_leaf(pair.b)) {
      open_pair(a, b, pair, ahead);
    } else if (visit(a.node(pair.a).leaf, b.node(pair.b).leaf) == Visit::stop) {
      return Visit::stop;
    }
  }
  return Visit::go_on;
}

/// The same for a tree and itself: each pair of leaves once, and each leaf with itself.
template <Bounding_volume Volume, class Visitor>
Visit walk_leaf_pairs_within(const Basic_region_tree<Volume>& tree, std::vector<Node_pair>& ahead, Visitor&& visit) {
  while (!ahead.empty()) {
    const Node_pair pair = ahead.back();
    ahead.pop_back();
    const bool leaves = tree.is_leaf(pair.a) && tree.is_leaf(pair.b);
    if (pair.a == pair.b) {
      if (!leaves) open_node(tree, pair.a, ahead);
    } else {
      if (!near(tree.volume(pair.a), tree.volume(pair.b), 0)) continue;
      if (!leaves) open_pair(tree, tree, pair, ahead);
    }
    if (leaves && visit(tree.node(pair.a).leaf, tree.node(pair.b).leaf) == Visit::stop) return Visit::stop;
  }
  return Visit::go_on;
}

}  // namespace lodestone
