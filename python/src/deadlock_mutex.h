// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <thread>

namespace lodestone::python {

/// A recursive mutex that notices deadlocks: the thread whose wait would never end gets an error. So functions of
/// Python's that a detector calls may ask other detectors.
class Deadlock_mutex {
 public:
  Deadlock_mutex() = default;
  Deadlock_mutex(const Deadlock_mutex&) = delete;
  Deadlock_mutex& operator=(const Deadlock_mutex&) = delete;

  /// @throws Bad_argument  a deadlock; the mutex stays as it was
  void lock();
  void unlock();

 private:
  struct Waits;

  static Waits& waits();
  void check_no_deadlock(const Waits& waits) const;

  std::thread::id owner_;
  int depth_ = 0;  ///< how often its owner has locked it; 0: it has none
};

}  // namespace lodestone::python
