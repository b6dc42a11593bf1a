// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/arena.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vector>

#include "mesh/thread_order.h"

namespace lodestone {

struct Arena::Threads {
  tbb::task_arena arena;
  std::vector<char> marks;  ///< an address per worker, and two for the beginning and end of all: see `comes_before`
};

Arena::Arena(std::size_t threads)
    : threads_(std::make_unique<Threads>(
          Threads{tbb::task_arena(static_cast<int>(threads)), std::vector<char>(threads + 2)})) {}
Arena::~Arena() = default;
Arena::Arena(Arena&&) noexcept = default;

std::size_t Arena::threads_here() { return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()); }

std::size_t Arena::most_threads() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

void Arena::enqueue(void (*task)(void*, std::size_t), void* subject, std::size_t number) {
  threads_->arena.enqueue([=] { task(subject, number); });
}

void Arena::run(std::size_t tasks, const std::function<void(std::size_t, std::size_t)>& task) {
  char* const marks = threads_->marks.data();
  char *const begin = marks + threads_->marks.size() - 2, *const end = begin + 1;
  const auto run_task = [&](std::size_t index) {
    const auto worker = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
    comes_after(begin);
    comes_after(marks + worker);  // another thread can have been this worker before
    task(index, worker);
    comes_before(marks + worker);
    comes_before(end);
  };
  comes_before(begin);
  threads_->arena.execute([&] { tbb::parallel_for(std::size_t{0}, tasks, run_task, tbb::simple_partitioner()); });
  comes_after(end);
}

}  // namespace lodestone

#if defined(LODESTONE_TSAN)
/// oneTBB's library is not instrumented: what it calls by itself, such as memcmp, looks like a race.
extern "C" const char* __tsan_default_suppressions() { return "called_from_lib:libtbb.so\n"; }
#endif
