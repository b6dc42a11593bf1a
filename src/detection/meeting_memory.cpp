// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/meeting_memory.h"

#include <algorithm>
#include <utility>

namespace lodestone {

void Meeting_memory::start_frame() {
  std::swap(last_, current_);
  current_.entries.clear();
  current_.meetings.clear();
}

std::span<const Remembered_meeting> Meeting_memory::recall(Object_pair pair) const {
  const auto entry = std::ranges::lower_bound(last_.entries, pair, {}, &Entry::pair);
  if (entry == last_.entries.end() || entry->pair != pair) return {};
  return std::span(last_.meetings).subspan(entry->first, entry->count);
}

void Meeting_memory::keep(Object_pair pair, const Remembered_meeting& meeting) {
  if (current_.entries.empty() || current_.entries.back().pair != pair)
    current_.entries.push_back({pair, current_.meetings.size(), 0});
  current_.meetings.push_back(meeting);
  ++current_.entries.back().count;
}

void Meeting_memory::forget(std::uint32_t object) {
  for (auto* frame : {&last_, &current_})
    std::erase_if(frame->entries,
                  [object](const Entry& entry) { return entry.pair.a == object || entry.pair.b == object; });
}

}  // namespace lodestone
