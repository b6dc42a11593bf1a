// SPDX-License-Identifier: GPL-3.0-or-later
// How many workers there are. What they do is tested in threads/workers_test.cpp, where eight threads are allowed.
#include "lodestone/mesh/workers.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace lodestone {
namespace {

/// Number of processors that this process may use.
std::size_t processors() {
  cpu_set_t allowed;
  EXPECT_EQ(sched_getaffinity(0, sizeof(allowed), &allowed), 0);
  return static_cast<std::size_t>(CPU_COUNT(&allowed));
}

TEST(Workers, zero_threads_means_as_many_as_the_machine_has) { EXPECT_EQ(Workers(0).count(), processors()); }

TEST(Workers, are_never_more_than_the_machine_has_and_do_not_print) {
  testing::internal::CaptureStderr();
  for (const std::size_t threads : {1, 2, 3, 8, 1000}) {
    Workers workers(threads);
    EXPECT_EQ(workers.count(), std::min(threads, processors()));
    workers.run(100, [](std::size_t, std::size_t) {});
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Workers, are_more_than_the_machine_has_where_a_global_control_allows_it) {
  using namespace std::chrono_literals;
  const std::size_t count = processors() + 3;
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, count);
  testing::internal::CaptureStderr();
  Workers workers(count);
  EXPECT_EQ(workers.count(), count);
  // Each task waits for all others, so that all must run at once.
  std::atomic<std::size_t> running = 0;
  const auto end = std::chrono::steady_clock::now() + 20s;
  workers.run(count, [&](std::size_t, std::size_t) {
    ++running;
    while (running < count && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    EXPECT_EQ(running, count);
  });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace lodestone
