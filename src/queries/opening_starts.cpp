// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/opening_starts.h"

#include <algorithm>

namespace lodestone {

void Opening_starts::begin(const Tree_on_demand& a, const Tree_on_demand& b, std::span<const Opening_start> starts,
                           std::size_t most) {
  start_search();
  pairs_.assign(starts.begin(), starts.end());
  places_.clear();
  a_.leaves.resize(std::max(a_.leaves.size(), a.layout().leaf_count()));
  b_.leaves.resize(std::max(b_.leaves.size(), b.layout().leaf_count()));
  for (const auto& start : starts) {
    places_.push_back({place(a_, a, start.nodes.a), place(b_, b, start.nodes.b)});
    whole_ = a_.vertices + b_.vertices <= most;
    if (!whole_) return;
  }
  is_start_.assign(a_.nodes * b_.nodes, 0);
  for (const Node_pair at : places_) is_start_[std::size_t{at.a} * b_.nodes + at.b] = 1;
}

void Opening_starts::start_search() {
  whole_ = true;
  for (Side* side : {&a_, &b_}) side->nodes = side->vertices = 0;
  if (++search_ != 0) return;
  for (Side* side : {&a_, &b_}) side->leaves.clear();
  search_ = 1;
}

/// The place of a node, whose leaves are marked if it comes first.
std::uint32_t Opening_starts::place(Side& side, const Tree_on_demand& tree, std::uint32_t node) const {
  const auto [first, end] = tree.leaves_below(node);
  if (side.leaves[first].search == search_) return side.leaves[first].node;
  const auto place = static_cast<std::uint32_t>(side.nodes++);
  std::fill(side.leaves.begin() + first, side.leaves.begin() + end, Place{search_, place});
  side.vertices += tree.layout().vertex_begin()[end] - tree.layout().vertex_begin()[first];
  return place;
}

}  // namespace lodestone
