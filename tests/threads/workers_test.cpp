// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/workers.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace lodestone {
namespace {

TEST(Workers, run_each_task_once) {
  for (const std::size_t threads : {1, 2, 3, 4, 7})
    for (const std::size_t tasks : {0, 1, 2, 5, 1000, 20000}) {
      Workers workers(threads);
      std::vector<std::atomic<int>> times(tasks);
      workers.run(tasks, [&](std::size_t index, std::size_t) { ++times.at(index); });
      for (const auto& count : times) ASSERT_EQ(count, 1);
    }
}

TEST(Workers, have_indices_below_their_count_that_no_two_tasks_have_at_once) {
  using namespace std::chrono_literals;
  for (const std::size_t threads : {1, 2, 4, 7}) {
    Workers workers(threads);
    EXPECT_LE(workers.count(), threads);
    EXPECT_GE(workers.count(), 1U);
    std::vector<std::atomic<bool>> busy(workers.count());
    std::atomic<int> shared = 0;
    for (const auto pause : {0us, 20us})
      workers.run(2000, [&](std::size_t, std::size_t worker) {
        if (busy.at(worker).exchange(true)) ++shared;
        if (pause > 0us)
          std::this_thread::sleep_for(pause);
        else
          std::this_thread::yield();
        busy.at(worker) = false;
      });
    EXPECT_EQ(shared, 0);
  }
}

TEST(Workers, a_single_worker_runs_tasks_in_order_in_the_calling_thread) {
  Workers workers(1);
  EXPECT_EQ(workers.count(), 1U);
  const auto caller = std::this_thread::get_id();
  std::vector<std::size_t> order;
  workers.run(100, [&](std::size_t index, std::size_t worker) {
    EXPECT_EQ(worker, 0U);
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(index);
  });
  ASSERT_EQ(order.size(), 100U);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
}

TEST(Workers, rethrow_an_exception_of_a_task_and_can_be_used_again) {
  for (const std::size_t threads : {1, 2, 4}) {
    Workers workers(threads);
    for (const std::size_t culprit : {0, 17, 99}) {
      const auto task = [&](std::size_t index, std::size_t) {
        if (index == culprit) throw std::out_of_range("task " + std::to_string(index));
      };
      try {
        workers.run(100, task);
        FAIL() << "nothing thrown";
      } catch (const std::out_of_range& error) {
        EXPECT_EQ(error.what(), "task " + std::to_string(culprit));
      }
      std::atomic<int> done = 0;
      workers.run(100, [&](std::size_t, std::size_t) { ++done; });
      EXPECT_EQ(done, 100);
    }
  }
}

TEST(Workers, rethrow_what_the_first_of_several_failing_tasks_throws) {
  for (const std::size_t threads : {1, 2, 4})
    for (int repeat = 0; repeat < 20; ++repeat) {
      const auto task = [](std::size_t index, std::size_t) {
        if (index % 10 == 7) throw std::out_of_range("task " + std::to_string(index));
      };
      try {
        Workers(threads).run(100, task);
        FAIL() << "nothing thrown";
      } catch (const std::out_of_range& error) {
        EXPECT_STREQ(error.what(), "task 7");
      }
    }
}

/// What one run has written is read by the next, mostly by other threads. No atomics but those of the workers order
/// them, which ThreadSanitizer checks.
TEST(Workers, finish_a_run_before_the_next_begins) {
  constexpr std::size_t tasks = 64;
  Workers workers(4);
  std::vector<std::size_t> now(tasks, 0), next(tasks);
  for (std::size_t run = 0; run < 2000; ++run) {
    workers.run(tasks, [&](std::size_t index, std::size_t) { next[index] = now[(index + 31) % tasks] + 1; });
    now.swap(next);
    if (run % 200 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // some leave meanwhile
  }
  EXPECT_EQ(now, std::vector<std::size_t>(tasks, 2000));
}

/// Tasks of one worker follow one another, so they may share what they keep.
TEST(Workers, need_no_lock_for_what_belongs_to_one_of_them) {
  Workers workers(4);
  std::vector<std::size_t> done(workers.count());
  for (int run = 0; run < 500; ++run) workers.run(100, [&](std::size_t, std::size_t worker) { ++done[worker]; });
  EXPECT_EQ(std::accumulate(done.begin(), done.end(), std::size_t{0}), 50000U);
}

TEST(Workers, can_be_nested) {
  Workers outer(2);
  std::atomic<int> done = 0;
  outer.run(10, [&](std::size_t, std::size_t) {
    Workers inner(2);
    inner.run(10, [&](std::size_t, std::size_t) { ++done; });
  });
  EXPECT_EQ(done, 100);
}

TEST(Workers, of_several_threads_at_once_run_each_task_once_again_and_again) {
  using namespace std::chrono_literals;
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 5);
  std::vector<std::thread> callers;
  for (const std::size_t threads : {2, 3, 5})
    callers.emplace_back([threads] {
      Workers workers(threads);
      for (std::size_t run = 0; run < 3000; ++run) {
        std::vector<std::atomic<int>> times(run % 40);
        std::vector<std::atomic<bool>> busy(workers.count());
        workers.run(times.size(), [&](std::size_t index, std::size_t worker) {
          EXPECT_FALSE(busy.at(worker).exchange(true));
          ++times.at(index);
          busy.at(worker) = false;
        });
        for (const auto& count : times) ASSERT_EQ(count, 1);
        if (run % 100 == 0) std::this_thread::sleep_for(std::chrono::microseconds(run / 10));  // some leave meanwhile
      }
    });
  for (auto& caller : callers) caller.join();
}

TEST(Workers, compute_in_the_floating_point_environment_of_the_caller) {
  using namespace std::chrono_literals;
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 3);
  Workers workers(3);
  for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TONEAREST}) {
    std::fesetround(rounding);
    std::atomic<int> others = 0;
    workers.run(300, [&](std::size_t, std::size_t) {
      if (std::fegetround() != rounding) ++others;
      std::this_thread::sleep_for(20us);
    });
    EXPECT_EQ(others, 0) << rounding;
  }
}

TEST(Workers, are_the_caller_alone_where_a_global_control_has_come_to_allow_no_more) {
  using namespace std::chrono_literals;
  Workers workers(2);
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  const auto caller = std::this_thread::get_id();
  std::atomic<int> others = 0;
  for (int run = 0; run < 20; ++run)
    workers.run(50, [&](std::size_t, std::size_t) {
      if (std::this_thread::get_id() != caller) ++others;
      std::this_thread::sleep_for(20us);
    });
  EXPECT_EQ(others, 0);
}

TEST(Workers, can_end_while_their_threads_wait_for_more) {
  for (int repeat = 0; repeat < 300; ++repeat) {
    Workers workers(3);
    std::atomic<int> done = 0;
    workers.run(10, [&](std::size_t, std::size_t) { ++done; });
    ASSERT_EQ(done, 10);
  }
}

TEST(Workers, can_be_moved) {
  for (const std::size_t threads : {1, 3}) {
    Workers first(threads);
    const std::size_t count = first.count();
    Workers second(std::move(first));
    EXPECT_EQ(second.count(), count);
    EXPECT_EQ(first.count(), 1U) << "the other works alone";  // NOLINT(bugprone-use-after-move)
    for (Workers* workers : {&first, &second}) {
      std::atomic<int> done = 0;
      workers->run(50, [&](std::size_t, std::size_t) { ++done; });
      EXPECT_EQ(done, 50);
    }
  }
}

}  // namespace
}  // namespace lodestone
