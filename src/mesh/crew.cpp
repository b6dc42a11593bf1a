// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/crew.h"

#include <hwy/cache_control.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

namespace lodestone {

namespace {

using Clock = std::chrono::steady_clock;

/// So long a member waits for more to do: longer than the pauses between the steps of a frame.
constexpr std::chrono::microseconds patience(100);

/// When the library is unloaded or the process ends.
struct Dismissal {
  Crew& crew;
  explicit Dismissal(Crew& of) : crew(of) {}
  Dismissal(const Dismissal&) = delete;
  ~Dismissal() { crew.dismiss(); }
};

/// The floating-point environment of another thread, for a while.
class Borrowed_environment {
 public:
  explicit Borrowed_environment(const std::fenv_t& environment) {
    std::fegetenv(&own_);
    std::fesetenv(&environment);
  }
  Borrowed_environment(const Borrowed_environment&) = delete;
  ~Borrowed_environment() { std::fesetenv(&own_); }

 private:
  std::fenv_t own_;
};

}  // namespace

Crew::Crew() : process_(::getpid()) {}

Crew& Crew::of_process() {
  static Crew* const crew = new Crew;  // never destroyed: a member that has not left may look at it
  static const Dismissal dismissal(*crew);
  return *crew;
}

void Crew::dismiss() {
  dismissed_ = true;
  if (::getpid() != process_) return;
  for (const auto end = Clock::now() + 100 * patience; any_present() && Clock::now() < end;) std::this_thread::yield();
}

bool Crew::any_present() const {
  return std::ranges::any_of(present_, [](const std::atomic<bool>& present) { return present.load(); });
}

bool Crew::run(Arena& arena, std::size_t workers, std::size_t tasks, const Task& task) {
  workers = std::min({workers, tasks, Arena::most_threads(), most_members + 1});
  if (workers < 2 || tasks > std::numeric_limits<std::uint32_t>::max()) return false;
  if (dismissed_ || ::getpid() != process_) return false;
  if (in_use_.exchange(true, std::memory_order_acquire)) return false;
  task_ = &task;
  std::fegetenv(&environment_);
  workers_ = workers;
  const auto begin_of = [&](std::size_t worker) { return static_cast<std::uint32_t>(tasks * worker / workers); };
  for (std::size_t worker = 0; worker < workers; ++worker)
    shares_[worker].left = {begin_of(worker), begin_of(worker + 1)};
  ++round_;
  call_members(arena, workers);
  work(0);
  ++round_;
  wait_for_members();
  in_use_.store(false, std::memory_order_release);
  return true;
}

/// Wakes threads in place of members that have left. Where memory has run out, others do their work.
void Crew::call_members(Arena& arena, std::size_t workers) {
  for (std::size_t member = 1; member < workers; ++member) {
    if (present_[member - 1].exchange(true)) continue;
    try {
      arena.enqueue([](void* crew, std::size_t number) { static_cast<Crew*>(crew)->serve(number); }, this, member);
    } catch (...) {
      present_[member - 1] = false;
    }
  }
}

/// After a round has been closed. A member that has seen it open has said before that it is inside, so nobody looks at
/// the round any more when nobody is inside.
void Crew::wait_for_members() const {
  for (std::size_t turn = 0; inside_ > 0; ++turn) {
    if (turn < 1000)
      hwy::Pause();
    else if (turn < 2000)
      std::this_thread::yield();
    else
      std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
}

/// Takes part in rounds until there has been none for a while.
void Crew::serve(std::size_t member) {
  std::uint64_t served = 0;
  do {
    for (auto last = Clock::now(); Clock::now() - last < patience && !dismissed_;) {
      for (int turn = 0; turn < 32; ++turn) {
        const std::uint64_t round = round_;
        if (round % 2 == 0 || round == served) {
          hwy::Pause();
          continue;
        }
        ++inside_;
        if (round_ == round && member < workers_) {
          const Borrowed_environment borrowed(environment_);
          work(member);
        }
        --inside_;
        served = round;
        last = Clock::now();
      }
    }
  } while (!has_left(member, served));
}

/// Leaves, unless a round has been opened meanwhile by a caller who thinks that this member is there.
bool Crew::has_left(std::size_t member, std::uint64_t served) {
  present_[member - 1] = false;
  const std::uint64_t round = round_;
  return round % 2 == 0 || round == served || dismissed_ || present_[member - 1].exchange(true);
}

void Crew::work(std::size_t member) {
  for (std::size_t index = 0; take(member, index);) (*task_)(index, member);
}

bool Crew::take(std::size_t member, std::size_t& index) {
  std::atomic<Left>& own = shares_[member].left;
  do {
    for (Left left = own; left.count() > 0;) {
      if (!own.compare_exchange_weak(left, {left.first + 1, left.end})) continue;
      index = left.first;
      return true;
    }
  } while (take_over(member));
  return false;
}

/// Takes over the second half of what the worker with the most tasks has left.
/// @return false if nobody has any
bool Crew::take_over(std::size_t member) {
  while (true) {
    std::size_t other = 0;
    Left most{0, 0};
    for (std::size_t worker = 0; worker < workers_; ++worker)
      if (const Left left = shares_[worker].left; left.count() > most.count()) most = left, other = worker;
    if (most.count() == 0) return false;
    const std::uint32_t middle = most.first + most.count() / 2;
    if (!shares_[other].left.compare_exchange_strong(most, {most.first, middle})) continue;
    shares_[member].left = {middle, most.end};  // it was empty, and nobody takes from an empty share
    return true;
  }
}

}  // namespace lodestone
