// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lodestone {

/// A group of threads that share tasks. But for `alone()`, it serves one thread at a time, and not its own tasks: these
/// may use another group.
class Workers {
 public:
  /// @param threads  number of threads, limited to as many as the machine has, or as a `tbb::global_control` allows if
  ///                 that is more; 0: as many as the machine has
  explicit Workers(std::size_t threads);
  ~Workers();
  /// Takes over the threads of another group, which then works alone.
  Workers(Workers&&) noexcept;

  /// A single worker. It has no state, so any number of threads may use it at once.
  static Workers& alone();

  /// Number of workers, at least 1.
  std::size_t count() const { return count_; }

  /// Calls `task(index, worker)` for each index below `tasks`; `worker` is below `count()`. A single worker runs the
  /// tasks in order, in the calling thread. Several workers run them in any order, but no two tasks of one worker at
  /// the same time. Rethrows what the first of the tasks that fail throws, in the order of their indices; tasks after
  /// it may be left out.
  ///
  /// Threads that have shared tasks wait a tenth of a millisecond for more of any group, so that the steps of a frame
  /// need not wake them again.
  void run(std::size_t tasks, const std::function<void(std::size_t, std::size_t)>& task);

 private:
  struct Threads;

  std::size_t count_;
  std::unique_ptr<Threads> threads_;  ///< null for a single worker
};

}  // namespace lodestone
