// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lodestone {

/// Threads of oneTBB. Its source is the only file that calls oneTBB, so the only one that ThreadSanitizer cannot see
/// into: see docs/testing.md.
class Arena {
 public:
  /// @param threads  at least 2
  explicit Arena(std::size_t threads);
  ~Arena();
  Arena(Arena&&) noexcept;

  /// So many threads the machine has, or where this is called from a task, the arena of that task.
  static std::size_t threads_here();
  /// So many threads oneTBB allows in all.
  static std::size_t most_threads();

  /// Has one of the threads call `task(subject, number)` sometime. Tells the thread nothing of what came before.
  /// @throws std::bad_alloc  nothing will be called
  void enqueue(void (*task)(void*, std::size_t), void* subject, std::size_t number);

  /// Calls `task(index, worker)` for each index below `tasks`; the caller waits and takes part. No two tasks of one
  /// worker run at the same time.
  /// @param task  throws nothing
  void run(std::size_t tasks, const std::function<void(std::size_t, std::size_t)>& task);

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;
};

}  // namespace lodestone
