// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/crew.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

namespace lodestone {

namespace {

/// So long a member waits for more to do: longer than the pauses between the steps of a frame.
constexpr std::chrono::microseconds patience(100);

/// When the library is unloaded or the process ends.
struct Dismissal {
  Crew& crew;
  explicit Dismissal(Crew& of) : crew(of) {}
  Dismissal(const Dismissal&) = delete;
  ~Dismissal() { crew.dismiss(); }
};

}  // namespace

Crew& Crew::of_process() {
  static Crew* const crew = new Crew;  // never destroyed: a member that has not left may look at it
  static const Dismissal dismissal(*crew);
  return *crew;
}

void Crew::dismiss() {
  using Clock = std::chrono::steady_clock;
  dismissed_ = true;
  for (const auto end = Clock::now() + 100 * patience; any_present() && Clock::now() < end;) std::this_thread::yield();
}

bool Crew::any_present() const {
  return std::ranges::any_of(present_, [](const std::atomic<bool>& present) { return present.load(); });
}

bool Crew::run(tbb::task_arena& arena, std::size_t workers, std::size_t tasks, const Task& task) {
  if (workers > most_members + 1 || tasks > std::numeric_limits<std::uint32_t>::max() || dismissed_) return false;
  if (in_use_.exchange(true, std::memory_order_acquire)) return false;
  task_ = &task;
  workers_ = workers;
  left_ = Left{0, static_cast<std::uint32_t>(tasks)};
  ++round_;
  call_members(arena, workers);
  work(0);
  ++round_;
  // A member that has seen the round open has said before that it is inside, so nobody looks at the task any more.
  for (std::size_t turns = 0; inside_ > 0; ++turns) {
    if (turns < 1000)
      hwy::Pause();
    else
      std::this_thread::yield();
  }
  in_use_.store(false, std::memory_order_release);
  return true;
}

/// Wakes threads in place of members that have left. Where memory has run out, others do their work.
void Crew::call_members(tbb::task_arena& arena, std::size_t workers) {
  for (std::size_t member = 1; member < workers; ++member) {
    if (present_[member - 1].exchange(true)) continue;
    try {
      arena.enqueue([this, member] { serve(member); });
    } catch (...) {
      present_[member - 1] = false;
    }
  }
}

/// Takes part in rounds until there has been none for a while.
void Crew::serve(std::size_t member) {
  std::uint64_t served = 0;
  auto last = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - last < patience && !dismissed_) {
    for (int turn = 0; turn < 32; ++turn) {
      const std::uint64_t round = round_;
      if (round % 2 == 0 || round == served) {
        hwy::Pause();
        continue;
      }
      ++inside_;
      if (round_ == round && member < workers_) work(member);
      --inside_;
      served = round;
      last = std::chrono::steady_clock::now();
    }
  }
  present_[member - 1] = false;
}

void Crew::work(std::size_t member) {
  for (std::size_t index = 0; take(member == 0, index);) (*task_)(index, member);
}

bool Crew::take(bool from_end, std::size_t& index) {
  Left left = left_;
  while (left.first < left.end) {
    const Left fewer = from_end ? Left{left.first, left.end - 1} : Left{left.first + 1, left.end};
    if (!left_.compare_exchange_weak(left, fewer)) continue;
    index = from_end ? fewer.end : left.first;
    return true;
  }
  return false;
}

}  // namespace lodestone
