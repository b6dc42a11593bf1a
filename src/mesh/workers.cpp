// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/workers.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace lodestone {

struct Workers::Threads {
  tbb::task_arena arena;
};

Workers::Workers(std::size_t threads)
    : count_(static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()))) {
  // oneTBB prints a warning and ignores the excess when it is asked for more threads than it allows.
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  if (threads > 0) count_ = std::min(std::max(count_, allowed), threads);
  if (count_ > 1) threads_ = std::make_unique<Threads>(Threads{tbb::task_arena(static_cast<int>(count_))});
}
Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;

Workers& Workers::alone() {
  static Workers workers(1);
  return workers;
}

void Workers::run(std::size_t tasks, const std::function<void(std::size_t, std::size_t)>& task) {
  if (!threads_ || tasks < 2) {
    for (std::size_t index = 0; index < tasks; ++index) task(index, 0);
    return;
  }
  threads_->arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, tasks,
        [&](std::size_t index) { task(index, static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())); },
        tbb::simple_partitioner());
  });
}

}  // namespace lodestone
