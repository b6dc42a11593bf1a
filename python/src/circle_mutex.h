// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

namespace lodestone::python {

/// A recursive mutex of which threads cannot wait in a circle, each for what the next one has. The thread that would
/// close the circle gets an error. So functions of Python's that a detector calls may ask other detectors.
class Circle_mutex {
 public:
  Circle_mutex() = default;
  Circle_mutex(const Circle_mutex&) = delete;
  Circle_mutex& operator=(const Circle_mutex&) = delete;

  /// @throws Bad_argument  this thread would wait for ever
  void lock();
  void unlock();

 private:
  void check_no_circle() const;

  // Of all of these, so that a thread sees who waits for whom. Held for some nanoseconds.
  static inline std::mutex guard_;
  static inline std::condition_variable unlocked_;
  static inline std::map<std::thread::id, const Circle_mutex*> waiting_;

  std::thread::id owner_;
  int depth_ = 0;  ///< how often its owner has locked it; 0: it has none
};

}  // namespace lodestone::python
