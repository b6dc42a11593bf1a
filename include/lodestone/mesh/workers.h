// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lodestone {

/// A number of threads that share tasks.
class Workers {
 public:
  /// @param threads  at most so many, and no more than the machine has; 0: as many as it has
  explicit Workers(std::size_t threads);
  ~Workers();
  Workers(Workers&&) noexcept;

  /// One worker. It keeps nothing, so any number of threads may use it at once.
  static Workers& alone();

  std::size_t count() const { return count_; }

  /// Calls `task(index, worker)` for each index below `tasks`. One worker: in order, in the calling thread. Several: in
  /// any order; no two tasks of one worker, a number below `count()`, run at the same time. Rethrows what a task
  /// throws.
  void run(std::size_t tasks, const std::function<void(std::size_t, std::size_t)>& task);

 private:
  struct Threads;

  std::size_t count_;
  std::unique_ptr<Threads> threads_;  ///< none for one worker
};

}  // namespace lodestone
