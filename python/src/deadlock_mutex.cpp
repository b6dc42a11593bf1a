// SPDX-License-Identifier: GPL-3.0-or-later
#include "deadlock_mutex.h"

#include <condition_variable>
#include <map>
#include <mutex>

#include "lodestone/mesh/errors.h"

namespace lodestone::python {

/// Which thread waits for which mutex, of all threads, and what guards the members of all mutexes.
struct Deadlock_mutex::Waits {
  std::mutex guard;
  std::condition_variable unlocked;
  std::map<std::thread::id, const Deadlock_mutex*> mutex_of;
};

/// Never destroyed: threads may still wait when the process ends, and destruction would wait for them.
Deadlock_mutex::Waits& Deadlock_mutex::waits() {
  static auto* const waits = new Waits;
  return *waits;
}

void Deadlock_mutex::lock() {
  const auto self = std::this_thread::get_id();
  Waits& all = waits();
  std::unique_lock guard(all.guard);
  while (depth_ > 0 && owner_ != self) {
    check_no_deadlock(all);
    all.mutex_of[self] = this;
    all.unlocked.wait(guard);
    all.mutex_of.erase(self);
  }
  owner_ = self;
  ++depth_;
}

void Deadlock_mutex::unlock() {
  Waits& all = waits();
  const std::lock_guard guard(all.guard);
  if (--depth_ == 0 && !all.mutex_of.empty()) all.unlocked.notify_all();
}

/// Follows who waits for whom, from this mutex on.
void Deadlock_mutex::check_no_deadlock(const Waits& all) const {
  for (const Deadlock_mutex* mutex = this; mutex->depth_ > 0;) {
    if (mutex->owner_ == std::this_thread::get_id())
      throw Bad_argument(
          "deadlock: a function that a detector calls (a visitor, a strategy, a promise) asks for a "
          "detector or a skin that another thread uses, and that thread waits for this one");
    const auto waits_for = all.mutex_of.find(mutex->owner_);
    if (waits_for == all.mutex_of.end()) return;
    mutex = waits_for->second;
  }
}

}  // namespace lodestone::python
