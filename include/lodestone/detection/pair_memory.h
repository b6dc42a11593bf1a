// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/particles/meeting.h"

namespace lodestone {

/// What the last frame kept of each object pair. Reuses its memory from frame to frame.
///
/// In a frame pairs must be kept in ascending order. They can be recalled in any order, and again.
template <class Item>
class Pair_memory {
 public:
  /// What was kept can now be recalled; what could be recalled is forgotten.
  void start_frame() {
    std::swap(last_, current_);
    current_.entries.clear();
    current_.items.clear();
  }
  /// As if the current frame had not been started: what it could recall can be recalled by the next one.
  void undo_frame() { std::swap(last_, current_); }
  /// What the last frame kept of a pair, in the order in which it kept it. O(log n) for n pairs.
  std::span<const Item> recall(Object_pair pair) const {
    const auto entry = std::ranges::lower_bound(last_.entries, pair, {}, &Entry::pair);
    if (entry == last_.entries.end() || entry->pair != pair) return {};
    return std::span(last_.items).subspan(entry->first, entry->count);
  }
  /// Keeps an item for the next frame.
  void keep(Object_pair pair, const Item& item) {
    if (current_.entries.empty() || current_.entries.back().pair != pair)
      current_.entries.push_back({pair, current_.items.size(), 0});
    current_.items.push_back(item);
    ++current_.entries.back().count;
  }
  /// Forgets all pairs of an object, whose vertices and faces have other indices now. O(n).
  void forget(std::uint32_t object) {
    for (auto* frame : {&last_, &current_})
      std::erase_if(frame->entries,
                    [object](const Entry& entry) { return entry.pair.a == object || entry.pair.b == object; });
  }

 private:
  /// The items of one pair: `count` of them, from `first` on.
  struct Entry {
    Object_pair pair;
    std::size_t first = 0, count = 0;
  };
  struct Frame_memory {
    std::vector<Entry> entries;  ///< ascending
    std::vector<Item> items;
  };

  Frame_memory last_, current_;
};

/// A meeting as the next frame recalls it.
struct Remembered_meeting {
  Meeting at;         ///< where the particles were
  Face_pair contact;  ///< two faces that intersected there
};

/// Where the particles of each object pair met.
using Meeting_memory = Pair_memory<Remembered_meeting>;

}  // namespace lodestone
