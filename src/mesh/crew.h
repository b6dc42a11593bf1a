// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "mesh/arena.h"

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

  /// Sends all members away. Waits until they have left, but not for long: a process that ends may have ended its
  /// threads already.
  void dismiss();

  /// Runs all tasks. The caller is worker 0. Each worker begins with its share of successive tasks; one that has done
  /// its own takes over half of what another has left. Members compute in the caller's floating-point environment.
  /// @param arena    of as many threads as there may be workers
  /// @param workers  so many at most
  /// @param task     throws nothing
  /// @return false if the crew serves another caller, maybe a task of which is asking, or if there is no member to
  ///         share the tasks: nothing has been done
  bool run(Arena& arena, std::size_t workers, std::size_t tasks, const Task& task);

 private:
  static constexpr std::size_t most_members = 255;

  /// Tasks that a worker has not begun yet. Aligned like a word, without which Clang reads and writes both at once only
  /// with a lock.
  struct alignas(std::uint64_t) Left {
    std::uint32_t first, end;
    std::uint32_t count() const { return end - first; }
  };
  /// Apart from those of others in memory: they are written often.
  struct alignas(64) Share {
    std::atomic<Left> left = Left{0, 0};
  };

  Crew();
  void call_members(Arena& arena, std::size_t workers);
  bool any_present() const;
  void serve(std::size_t member);
  bool has_left(std::size_t member, std::uint64_t served);
  void work(std::size_t member);
  bool take(std::size_t member, std::size_t& index);
  bool take_over(std::size_t member);
  void wait_for_members() const;

  pid_t process_;  ///< in which it was made: one that is forked from it has none of the members
  std::atomic<bool> in_use_ = false, dismissed_ = false;
  std::atomic<bool> present_[most_members] = {};  ///< member i is worker i + 1
  // The round that is played.
  const Task* task_ = nullptr;
  std::fenv_t environment_ = {};
  std::atomic<std::size_t> workers_ = 0;
  alignas(64) std::atomic<std::uint64_t> round_ = 0;  ///< odd: it is open
  alignas(64) std::atomic<std::size_t> inside_ = 0;   ///< members that may look at the round
  Share shares_[most_members + 1];                    ///< per worker
};

}  // namespace lodestone
