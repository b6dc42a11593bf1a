// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/particles/meeting.h"

namespace lodestone {

/// A meeting as the next frame recalls it.
struct Remembered_meeting {
  Meeting at;
  Face_pair contact;  ///< two faces that intersected there
};

/// Where the particles of each object pair met in the last frame. Reuses its memory from frame to frame.
///
/// In a frame pairs must be recalled in ascending order, and so must they be kept.
class Meeting_memory {
 public:
  void start_frame();
  /// The meetings of a pair that the last frame kept, in the order in which it kept them.
  std::span<const Remembered_meeting> recall(Object_pair pair);
  /// Remembers a meeting for the next frame.
  void keep(Object_pair pair, const Remembered_meeting& meeting);
  /// Forgets all meetings of an object, whose vertices and faces have other indices now.
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
  std::size_t next_ = 0;  ///< the entry of the last frame that is recalled next
};

}  // namespace lodestone
