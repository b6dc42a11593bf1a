// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/tree/tree_walk.h"

namespace lodestone {

/// Counts of a walk over two trees.
struct Walk_counts {
  std::size_t volume_tests = 0;  ///< pairs of volumes compared
  std::size_t leaf_pairs = 0;    ///< candidate pairs of leaves: their volumes do not prove them apart
};

/// Counts what a walk down to the leaves compares when it looks for all contacts.
///
/// This walk is separate from the timed one, because a counter would slow that one. Over boxes the timed walk also
/// differs: at small subtrees it compares all leaves with all leaves.
template <Bounding_volume Volume>
Walk_counts count_walk(const Basic_region_tree<Volume>& a, const Basic_region_tree<Volume>& b) {
  Walk_counts counts;
  std::vector<Node_pair> ahead{{0, 0}};
  while (!ahead.empty()) {
    const Node_pair pair = ahead.back();
    ahead.pop_back();
    ++counts.volume_tests;
    if (!near(a.volume(pair.a), b.volume(pair.b), 0)) continue;
    if (a.is_leaf(pair.a) && b.is_leaf(pair.b))
      ++counts.leaf_pairs;
    else
      open_pair(a, b, pair, ahead);
  }
  return counts;
}

}  // namespace lodestone
