// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace lodestone {

/// Threads that stay awake for a while after they have shared some tasks. A frame shares tasks several times within a
/// fraction of a millisecond, and to wake a thread takes about as long as each of these times.
///
/// All groups of workers have one crew in common, so that no thread waits for one group while another has work. It
/// serves one caller at a time.
class Crew {
 public:
  /// One task: its index, and the worker that runs it.
  using Task = std::function<void(std::size_t, std::size_t)>;

  static Crew& of_process();

  /// Sends all members away. Waits until they have left, so that the library can be unloaded; not for long, since a
  /// process that ends may have ended its threads already.
  void dismiss();

  /// Runs all tasks. The caller is worker 0 and begins with the last task; the others begin with the first.
  /// @param arena    of as many threads as there may be workers
  /// @param workers  at least 2
  /// @param task     throws nothing
  /// @return false if the crew serves somebody else, maybe a task of whom is asking, or is too small: nothing has been
  ///         done
  bool run(tbb::task_arena& arena, std::size_t workers, std::size_t tasks, const Task& task);

 private:
  static constexpr std::size_t most_members = 64;

  /// The tasks that nobody has taken: from the first on, and how many.
  struct Left {
    std::uint32_t first, end;
  };

  void call_members(tbb::task_arena& arena, std::size_t workers);
  bool any_present() const;
  void serve(std::size_t member);
  void work(std::size_t member);
  bool take(bool from_end, std::size_t& index);

  std::atomic<bool> in_use_ = false, dismissed_ = false;
  std::atomic<bool> present_[most_members] = {};  ///< member i is worker i + 1
  // The round that is played.
  std::atomic<std::uint64_t> round_ = 0;  ///< odd: it is open
  std::atomic<std::size_t> workers_ = 0;
  std::atomic<Left> left_ = Left{0, 0};
  const Task* task_ = nullptr;
  std::atomic<std::size_t> inside_ = 0;  ///< members that may look at the round
};

}  // namespace lodestone
