// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/particles/meeting.h"

namespace lodestone {

/// A meeting as the next frame recalls it.
struct Remembered_meeting {
  Meeting at;         ///< where the particles were
  Face_pair contact;  ///< two faces that intersected there
};

/// Where the particles of each object pair met in the last frame. Reuses its memory from frame to frame.
///
/// In a frame pairs must be kept in ascending order. They can be recalled in any order, and again.
class Meeting_memory {
 public:
  /// What was kept can now be recalled; what could be recalled is forgotten.
  void start_frame();
  /// As if the current frame had not been started: what it could recall can be recalled by the next one.
  void undo_frame() { std::swap(last_, current_); }
  /// The meetings of a pair that the last frame kept, in the order in which it kept them. O(log n) for n pairs.
  std::span<const Remembered_meeting> recall(Object_pair pair) const;
  /// Remembers a meeting for the next frame.
  void keep(Object_pair pair, const Remembered_meeting& meeting);
  /// Forgets all meetings of an object, whose vertices and faces have other indices now. O(n).
  void forget(std::uint32_t object);

 private:
  /// The meetings of one pair: `count` of them, from `first` on.
  struct Entry {
    Object_pair pair;
    std::size_t first = 0, count = 0;
  };
  struct Frame_memory {
    std::vector<Entry> entries;  ///< ascending
    std::vector<Remembered_meeting> meetings;
  };

  Frame_memory last_, current_;
};

}  // namespace lodestone
