// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/tree/tree_walk.h"

namespace lodestone {

/// What a walk over two trees looks at.
struct Walk_counts {
  std::size_t volume_tests = 0;  ///< pairs of volumes compared
  std::size_t leaf_pairs = 0;    ///< pairs of leaves whose volumes do not prove them apart
};

/// Counts what a walk down to leaves looks at when it looks for all contacts: a walk of its own, for a counter would
/// slow the one that is timed, which over boxes compares leaves of small subtrees all with all instead.
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
