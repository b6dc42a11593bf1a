// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/workers.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "mesh/crew.h"
#include "mesh/thread_order.h"

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
  tbb::task_arena arena;
  std::vector<char> marks;  ///< an address per worker, and one for the end of all tasks: see `comes_before`
};

Workers::Workers(std::size_t threads)
    : count_(static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()))) {
  // oneTBB prints a warning and ignores the excess when it is asked for more threads than it allows.
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  if (threads > 0) count_ = std::min(std::max(count_, allowed), threads);
  if (count_ > 1)
    threads_ =
        std::make_unique<Threads>(Threads{tbb::task_arena(static_cast<int>(count_)), std::vector<char>(count_ + 1)});
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
  const auto run_task = [&](std::size_t index, std::size_t worker) {
    comes_after(&failure);
    comes_after(threads_->marks.data() + worker);  // another thread can have been this worker before
    run_unless_failed(task, index, worker, failure);
    comes_before(threads_->marks.data() + worker);
    comes_before(threads_->marks.data() + count_);
  };
  comes_before(&failure);
  if (!Crew::of_process().run(threads_->arena, count_, tasks, std::cref(run_task))) {
    const auto run_here = [&](std::size_t index) {
      run_task(index, static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
    };
    threads_->arena.execute([&] { tbb::parallel_for(std::size_t{0}, tasks, run_here, tbb::simple_partitioner()); });
  }
  comes_after(threads_->marks.data() + count_);
  failure.rethrow();
}

}  // namespace lodestone
