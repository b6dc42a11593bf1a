// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/tree/leaf_candidates.h"
#include "lodestone/tree/region_tree.h"

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

/// Lists the leaves below two nodes whose boxes come within `margin` of each other, by a's leaf, then b's.
/// @param pair  with at most `bunch_leaves` leaves each
void list_leaf_candidates(const Region_tree& a, const Region_tree& b, Node_pair pair, double margin,
                          Leaf_candidates& near);

/// Whether a walk opens this pair of near nodes no further.
template <Bounding_volume Volume>
bool ends_walk(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b, Node_pair pair) {
  const std::uint32_t most = std::same_as<Volume, Aabb> ? bunch_leaves : 1;
  const auto &node_a = a.node(pair.a), &node_b = b.node(pair.b);
  return node_a.end_leaf - node_a.leaf <= most && node_b.end_leaf - node_b.leaf <= most;
}

/// Puts near leaves from number `first` on onto the stack, the last to be visited first.
inline void push_leaf_candidates(const Tree_layout& a, const Tree_layout& b, const Leaf_candidates& near,
                                 std::size_t first, std::vector<Node_pair>& ahead) {
  for (std::size_t i = near.count; i-- > first;)
    ahead.push_back({a.leaf_node(near.first_a + near.a[i]), b.leaf_node(near.first_b + near.b[i])});
}

/// Replaces a pair of near nodes by the pairs below it that a walk would visit instead.
/// @return false: it is one of leaves
template <Bounding_volume Volume>
bool open_for_tasks(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b, Node_pair pair,
                    double margin, std::vector<Node_pair>& below) {
  if (a.is_leaf(pair.a) && b.is_leaf(pair.b)) return false;
  if (!ends_walk(a, b, pair)) {
    open_pair(a, b, pair, below);
  } else if constexpr (std::same_as<Volume, Aabb>) {
    Leaf_candidates near;
    list_leaf_candidates(a, b, pair, margin, near);
    push_leaf_candidates(a, b, near, 0, below);
  }
  return true;
}

/// Visits the near leaves below a pair of nodes; after a stop the others are on the stack.
template <class Visitor>
Visit visit_leaf_candidates(const Region_tree& a, const Region_tree& b, Node_pair pair, double margin,
                            std::vector<Node_pair>& ahead, Visitor&& visit) {
  Leaf_candidates near;
  list_leaf_candidates(a, b, pair, margin, near);
  for (std::size_t i = 0; i < near.count; ++i) {
    if (visit(near.first_a + near.a[i], near.first_b + near.b[i]) == Visit::go_on) continue;
    push_leaf_candidates(a, b, near, i + 1, ahead);
    return Visit::stop;
  }
  return Visit::go_on;
}

/// Visits the near leaves below a pair of nodes, or puts the pairs below it on the stack.
template <Bounding_volume Volume, class Visitor>
Visit visit_below(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b, Node_pair pair, double margin,
                  std::vector<Node_pair>& ahead, Visitor&& visit) {
  if (!near(a.volume(pair.a), b.volume(pair.b), margin)) return Visit::go_on;
  if (!ends_walk(a, b, pair)) {
    open_pair(a, b, pair, ahead);
    return Visit::go_on;
  }
  if constexpr (std::same_as<Volume, Aabb>)
    return visit_leaf_candidates(a, b, pair, margin, ahead, visit);
  else
    return visit(a.node(pair.a).leaf, b.node(pair.b).leaf);
}

/// Visits the pairs of leaves whose volumes do not prove them farther apart than `margin`, below the nodes on the stack
/// `ahead`. The order depends on the volumes, and on the numbers of leaves, alone. After a stop what has not been
/// visited is still on the stack.
///
/// @param visit  called with the numbers of a leaf of a and a leaf of b, returns a `Visit`
template <Bounding_volume Volume, class Visitor>
Visit walk_leaf_pairs(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b, double margin,
                      std::vector<Node_pair>& ahead, Visitor&& visit) {
  while (!ahead.empty()) {
    const Node_pair pair = ahead.back();
    ahead.pop_back();
    if (visit_below(a, b, pair, margin, ahead, visit) == Visit::stop) return Visit::stop;
  }
  return Visit::go_on;
}

/// The same for a tree and itself: each pair of leaves once, and each leaf with itself.
template <Bounding_volume Volume, class Visitor>
Visit walk_leaf_pairs_within(const Basic_region_tree<Volume>& tree, std::vector<Node_pair>& ahead, Visitor&& visit) {
  while (!ahead.empty()) {
    const Node_pair pair = ahead.back();
    ahead.pop_back();
    if (pair.a != pair.b) {
      if (visit_below(tree, tree, pair, 0, ahead, visit) == Visit::stop) return Visit::stop;
    } else if (!tree.is_leaf(pair.a)) {
      open_node(tree, pair.a, ahead);
    } else if (visit(tree.node(pair.a).leaf, tree.node(pair.a).leaf) == Visit::stop) {
      return Visit::stop;
    }
  }
  return Visit::go_on;
}

}  // namespace lodestone
