// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "lodestone/tree/leaf_candidates.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/region_tree.h"

namespace lodestone {

/// What a visitor answers: whether the walk goes on. Also what a walk returns.
enum class Visit {
  go_on,  ///< there may be more
  stop,   ///< no more is wanted
};

/// A budget that no walk uses up.
inline constexpr std::size_t no_budget = std::numeric_limits<std::size_t>::max();

/// Lists the leaf pairs below two nodes whose boxes come within `margin` of each other, in ascending order of a's leaf,
/// then b's.
/// @param pair  nodes with at most `bunch_leaves` leaves each
void list_leaf_candidates(const Region_tree& a, const Region_tree& b, Node_pair pair, double margin,
                          Leaf_candidates& candidates);

/// Visits the candidate leaf pairs of two trees, or of one tree and itself: those whose volumes do not prove them
/// farther apart than a margin. Each pair is visited once. A walk can pause after any pair and go on later.
///
/// The order of the visits depends on the volumes and on the indices of nodes alone. Pauses do not change it.
///
/// It is reused: its stack keeps its memory from one walk to the next.
template <Bounding_volume Volume>
class Tree_walk {
 public:
  using Tree = Basic_region_tree<Volume>;  ///< what is walked

  /// A walk over two trees, from their roots.
  /// @param a, b    not refitted, and not destroyed, before the last `run`
  /// @param margin  >= 0, in units of the coordinates
  void begin(const Tree& a, const Tree& b, double margin) {
    a_ = &a, b_ = &b;
    margin_ = margin;
    self_walk_ = false;
    start();
  }
  /// Self-walk: each pair of leaves once, in either order, and each leaf with itself.
  void begin_within(const Tree& tree, double margin) {
    begin(tree, tree, margin);
    self_walk_ = true;
  }
  /// Starts anew in the same trees: what lies below one node pair is all that will be visited. Resets the count.
  void start(Node_pair from = root_pair) {
    stack_.assign(1, from);
    leaf_tests_ = 0;
  }

  /// Visits leaf pairs until the visitor stops the walk, the budget is used up, or none is left. After a pause the next
  /// `run` goes on with the next leaf pair.
  ///
  /// @param visit   called with the indices of a leaf of a and a leaf of b; returns a `Visit`
  /// @param budget  most leaf pairs to visit
  /// @return stop if the visitor or the budget ended this run, even after the last leaf pair; else go_on
  template <class Visitor>
  Visit run(Visitor&& visit, std::size_t budget = no_budget) {
    if (budget == 0) return Visit::stop;
    const auto visit_leaves = [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
      ++leaf_tests_;
      if (visit(leaf_a, leaf_b) == Visit::stop) return Visit::stop;
      return --budget > 0 ? Visit::go_on : Visit::stop;
    };
    while (!stack_.empty()) {
      const Node_pair pair = stack_.back();
      stack_.pop_back();
      if (descend(pair, visit_leaves) == Visit::stop) return Visit::stop;
    }
    return Visit::go_on;
  }

  /// Whether no node pair is left.
  bool done() const { return stack_.empty(); }
  /// Leaf pairs visited since `start`.
  std::size_t leaf_tests() const { return leaf_tests_; }
  /// Whether the walk is one of a tree against itself.
  bool self_walk() const { return self_walk_; }

  /// Cuts the rest of the walk into parts, for others to walk from, and ends it. Walks that start from these node
  /// pairs, in their order, visit what was left, in the same order.
  /// @param more    how many parts more than node pairs are left: those may be leaf pairs, too small to be shared.
  ///                There are fewer where so many cannot be had
  /// @param starts  replaced
  void split(std::size_t more, std::vector<Node_pair>& starts);

 private:
  template <class Visitor>
  Visit descend(Node_pair pair, Visitor& visit);
  template <class Visitor>
  Visit visit_leaves_below(Node_pair pair, Visitor& visit);
  bool open_one_level(Node_pair pair, std::vector<Node_pair>& stack) const;
  void push_leaf_candidates(const Leaf_candidates& candidates, std::size_t first, std::vector<Node_pair>& stack) const;

  /// Whether a self-walk has met a node paired with itself.
  bool is_with_itself(Node_pair pair) const { return self_walk_ && pair.a == pair.b; }
  bool is_leaf_pair(Node_pair pair) const { return a_->is_leaf(pair.a) && b_->is_leaf(pair.b); }
  bool is_candidate(Node_pair pair) const {
    return is_with_itself(pair) || near(a_->volume(pair.a), b_->volume(pair.b), margin_);
  }
  /// Whether the leaf pairs below a candidate are visited without opening it further.
  bool ends_descent(Node_pair pair) const {
    if (is_with_itself(pair)) return a_->is_leaf(pair.a);
    constexpr std::uint32_t most = std::same_as<Volume, Aabb> ? bunch_leaves : 1;
    const auto &node_a = a_->node(pair.a), &node_b = b_->node(pair.b);
    return node_a.end_leaf - node_a.leaf <= most && node_b.end_leaf - node_b.leaf <= most;
  }
  void open(Node_pair pair, std::vector<Node_pair>& stack) const {
    if (is_with_itself(pair))
      open_with_itself(*a_, pair.a, stack);
    else
      open_pair(*a_, *b_, pair, stack);
  }

  const Tree* a_ = nullptr;
  const Tree* b_ = nullptr;
  double margin_ = 0;
  bool self_walk_ = false;
  std::vector<Node_pair> stack_;  ///< what is left, the next node pair last
  std::size_t leaf_tests_ = 0;
};

/// Visits the leaf pairs below a node pair if they are few, else puts what lies one level below on the stack.
template <Bounding_volume Volume>
template <class Visitor>
Visit Tree_walk<Volume>::descend(Node_pair pair, Visitor& visit) {
  if (!is_candidate(pair)) return Visit::go_on;
  if (ends_descent(pair)) return visit_leaves_below(pair, visit);
  open(pair, stack_);
  return Visit::go_on;
}

/// After a stop, the leaf pairs that have not been visited are on the stack.
template <Bounding_volume Volume>
template <class Visitor>
Visit Tree_walk<Volume>::visit_leaves_below(Node_pair pair, Visitor& visit) {
  if constexpr (std::same_as<Volume, Aabb>) {
    if (!is_with_itself(pair)) {
      Leaf_candidates candidates;
      list_leaf_candidates(*a_, *b_, pair, margin_, candidates);
      for (std::size_t i = 0; i < candidates.count; ++i) {
        if (visit(candidates.leaf_a(i), candidates.leaf_b(i)) == Visit::go_on) continue;
        push_leaf_candidates(candidates, i + 1, stack_);
        return Visit::stop;
      }
      return Visit::go_on;
    }
  }
  return visit(a_->node(pair.a).leaf, b_->node(pair.b).leaf);
}

template <Bounding_volume Volume>
void Tree_walk<Volume>::split(std::size_t more, std::vector<Node_pair>& starts) {
  starts.assign(stack_.rbegin(), stack_.rend());
  stack_.clear();
  const std::size_t enough = starts.size() + more;
  std::vector<Node_pair> below, opened;
  for (bool again = true; again && starts.size() < enough; starts.swap(opened)) {
    again = false;
    opened.clear();
    for (const Node_pair pair : starts) {
      below.clear();
      if (opened.size() < enough && open_one_level(pair, below)) {
        again = true;
        opened.insert(opened.end(), below.rbegin(), below.rend());
      } else {
        opened.push_back(pair);
      }
    }
  }
}

/// Pushes what a walk would visit in place of a node pair: nothing if it is no candidate.
/// @return false, with nothing pushed, for a candidate leaf pair
template <Bounding_volume Volume>
bool Tree_walk<Volume>::open_one_level(Node_pair pair, std::vector<Node_pair>& stack) const {
  if (!is_candidate(pair)) return true;
  if (is_leaf_pair(pair)) return false;
  if (!ends_descent(pair)) {
    open(pair, stack);
  } else if constexpr (std::same_as<Volume, Aabb>) {
    Leaf_candidates candidates;
    list_leaf_candidates(*a_, *b_, pair, margin_, candidates);
    push_leaf_candidates(candidates, 0, stack);
  }
  return true;
}

/// Pushes candidates from index `first` on, the next to be visited last.
template <Bounding_volume Volume>
void Tree_walk<Volume>::push_leaf_candidates(const Leaf_candidates& candidates, std::size_t first,
                                             std::vector<Node_pair>& stack) const {
  for (std::size_t i = candidates.count; i-- > first;)
    stack.push_back({a_->leaf_node(candidates.leaf_a(i)), b_->leaf_node(candidates.leaf_b(i))});
}

}  // namespace lodestone
