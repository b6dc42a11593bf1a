// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/tree/tree_layout.h"

/// What bounds have in common: lists per node, made from the leaves up.
namespace lodestone {

/// A result rounded to nearest differs from the exact one by at most this share.
inline constexpr double unit_roundoff = 0x1p-53;

/// Two lists that ascend by a key, as one.
/// @param alone     called for an entry whose key only one list has
/// @param together  called for an entry, and that of the other list with the same key
template <class Entry, class Key, class Alone, class Together>
std::vector<Entry> merged_lists(std::span<const Entry> a, std::span<const Entry> b, Key key, Alone alone,
                                Together together) {
  std::vector<Entry> merged;
  for (auto i = a.begin(), j = b.begin(); i != a.end() || j != b.end();) {
    const bool from_a = j == b.end() || (i != a.end() && key(*i) <= key(*j));
    const bool from_both = from_a && j != b.end() && key(*i) == key(*j);
    Entry entry = from_a ? *i++ : *j++;
    if (from_both)
      together(entry, *j++);
    else
      alone(entry);
    merged.push_back(entry);
  }
  return merged;
}

/// Makes the lists of all nodes: those of leaves from their vertices, the others from those of their children.
/// @param lists  of all nodes, one after the other
/// @param begin  per node and past the last: where its list starts
template <class Entry, class Of_leaf, class Merged>
void node_lists(const Tree_layout& layout, Of_leaf of_leaf, Merged merged, std::vector<Entry>& lists,
                std::vector<std::uint64_t>& begin) {
  const auto count = static_cast<std::uint32_t>(layout.node_count());
  std::vector<std::vector<Entry>> by_node(count);
  std::size_t total = 0;
  for (std::uint32_t node = count; node-- > 0;) {
    by_node[node] = layout.is_leaf(node) ? of_leaf(layout.vertices(layout.node(node).leaf))
                                         : merged(by_node[node + 1], by_node[layout.node(node).second_child]);
    total += by_node[node].size();
  }
  lists.reserve(total);
  begin.push_back(0);
  for (const auto& list : by_node) {
    lists.insert(lists.end(), list.begin(), list.end());
    begin.push_back(lists.size());
  }
}

}  // namespace lodestone
