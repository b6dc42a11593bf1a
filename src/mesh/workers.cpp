// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/workers.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>

#include "mesh/arena.h"
#include "mesh/crew.h"

namespace lodestone {

namespace {

/// The failure of the first task that fails, whichever thread runs it.
class First_failure {
 public:
  explicit First_failure(std::size_t tasks) : index_(tasks) {}

  /// Whether a task can be left out, because one before it has failed.
  bool is_before(std::size_t index) const { return index_ < index; }
  /// Takes the exception that is being handled.
  void take(std::size_t index) {
    const std::lock_guard lock(mutex_);
    if (index > index_) return;
    index_ = index;
    exception_ = std::current_exception();
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic<std::size_t> index_;
  std::exception_ptr exception_;
  std::mutex mutex_;
};

void run_unless_failed(const std::function<void(std::size_t, std::size_t)>& task, std::size_t index, std::size_t worker,
                       First_failure& failure) {
  if (failure.is_before(index)) return;
  try {
    task(index, worker);
  } catch (...) {
    failure.take(index);
  }
}

}  // namespace

struct Workers::Threads {
  Arena arena;
};

Workers::Workers(std::size_t threads) : count_(std::max(std::size_t{1}, Arena::threads_here())) {
  // oneTBB prints a warning and ignores the excess when it is asked for more threads than it allows.
  if (threads > 0) count_ = std::min(std::max(count_, Arena::most_threads()), threads);
  if (count_ > 1) threads_ = std::make_unique<Threads>(Threads{Arena(count_)});
}
Workers::~Workers() = default;
Workers::Workers(Workers&& other) noexcept
    : count_(std::exchange(other.count_, 1)), threads_(std::move(other.threads_)) {}

Workers& Workers::alone() {
  static Workers workers(1);
  return workers;
}

void Workers::run(std::size_t tasks, const std::function<void(std::size_t, std::size_t)>& task) {
  if (!threads_ || tasks < 2) {
    for (std::size_t index = 0; index < tasks; ++index) task(index, 0);
    return;
  }
  First_failure failure(tasks);
  const auto run_task = [&](std::size_t index, std::size_t worker) { run_unless_failed(task, index, worker, failure); };
  if (!Crew::of_process().run(threads_->arena, count_, tasks, std::cref(run_task)))
    threads_->arena.run(tasks, std::cref(run_task));
  failure.rethrow();
}

}  // namespace lodestone
