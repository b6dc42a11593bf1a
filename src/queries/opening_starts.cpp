// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/opening_starts.h"

#include <algorithm>
#include <tuple>

namespace lodestone {

namespace {

bool comes_before(Node_pair one, Node_pair other) { return std::tie(one.a, one.b) < std::tie(other.a, other.b); }

}  // namespace

void Opening_starts::begin(const Tree_layout& a, const Tree_layout& b, std::span<const Opening_start> starts,
                           std::size_t most) {
  start_search();
  pairs_.assign(starts.begin(), starts.end());
  a_.resize(std::max(a_.size(), a.leaf_count()));
  b_.resize(std::max(b_.size(), b.leaf_count()));
  std::size_t vertices = 0;
  for (const auto& start : starts) {
    vertices += mark_below(a_, a, start.nodes.a, most - vertices);
    whole_ = vertices <= most;
    if (whole_) vertices += mark_below(b_, b, start.nodes.b, most - vertices);
    whole_ = vertices <= most;
    if (!whole_) return;
  }
  nodes_.clear();
  for (const auto& start : starts) nodes_.push_back(start.nodes);
  std::ranges::sort(nodes_, comes_before);
}

bool Opening_starts::cover(Leaf_pair leaves) const {
  if (!whole_) return false;
  const Mark a = a_[leaves.a], b = b_[leaves.b];
  return a.search == search_ && b.search == search_ &&
         std::ranges::binary_search(nodes_, Node_pair{a.node, b.node}, comes_before);
}

void Opening_starts::start_search() {
  whole_ = true;
  if (++search_ != 0) return;
  a_.clear(), b_.clear();
  search_ = 1;
}

/// Marks the leaves below a node, unless they have been marked, or have more than `most` vertices.
/// @return the number of their vertices; 0 if they have been marked
std::size_t Opening_starts::mark_below(Marks& marks, const Tree_layout& tree, std::uint32_t node,
                                       std::size_t most) const {
  const Tree_layout::Node& below = tree.node(node);
  if (marks[below.leaf].search == search_) return 0;
  const std::size_t vertices = tree.vertex_begin()[below.end_leaf] - tree.vertex_begin()[below.leaf];
  if (vertices <= most) std::fill(marks.begin() + below.leaf, marks.begin() + below.end_leaf, Mark{search_, node});
  return vertices;
}

}  // namespace lodestone
