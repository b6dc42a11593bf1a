// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_mutex.h"

#include "lodestone/mesh/errors.h"

namespace lodestone::python {

void Circle_mutex::lock() {
  const auto self = std::this_thread::get_id();
  std::unique_lock guard(guard_);
  while (depth_ > 0 && owner_ != self) {
    check_no_circle();
    waiting_[self] = this;
    unlocked_.wait(guard);
    waiting_.erase(self);
  }
  owner_ = self;
  ++depth_;
}

void Circle_mutex::unlock() {
  const std::lock_guard guard(guard_);
  if (--depth_ == 0 && !waiting_.empty()) unlocked_.notify_all();
}

/// Follows who waits for whom, from this mutex on.
void Circle_mutex::check_no_circle() const {
  for (const Circle_mutex* mutex = this; mutex->depth_ > 0;) {
    if (mutex->owner_ == std::this_thread::get_id())
      throw Bad_argument("two threads would wait for each other: a function that a detector calls (a visitor, a strategy, "
                         "a promise) asks for a detector or a skin whose thread waits for the first detector");
    const auto waits_for = waiting_.find(mutex->owner_);
    if (waits_for == waiting_.end()) return;
    mutex = waits_for->second;
  }
}

}  // namespace lodestone::python
