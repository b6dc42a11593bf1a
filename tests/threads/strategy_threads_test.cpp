// SPDX-License-Identifier: GPL-3.0-or-later
// Objects are divided side by side by strategies that allow it, and by no other.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "support/exact_truth.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

/// What happened in the calls of a strategy.
struct Calls {
  std::mutex guard;
  std::condition_variable changed;
  std::set<std::thread::id> threads = {};
  std::size_t running = 0, most_running = 0;
  std::size_t awaited = 1;  ///< a call returns when so many have been running at once, or after a while
  std::chrono::milliseconds patience{60'000};
  bool fail_on_second = false;
};

/// Two halves along x. Refuses, if asked to, surfaces that begin at x > 0.
struct Halves {
  static constexpr std::string_view name = "halves";
  bool is_concurrent;
  std::shared_ptr<Calls> calls = std::make_shared<Calls>();

  Labelling label(const Numbered_surface& surface, std::size_t) const {
    std::unique_lock lock(calls->guard);
    calls->threads.insert(std::this_thread::get_id());
    calls->most_running = std::max(calls->most_running, ++calls->running);
    calls->changed.notify_all();
    calls->changed.wait_for(lock, calls->patience, [&] { return calls->most_running >= calls->awaited; });
    --calls->running;
    if (calls->fail_on_second && surface.positions.col(0).minCoeff() > 0) throw Bad_argument("halves: no");
    const double middle = surface.positions.col(0).mean();
    Labelling result;
    for (const double x : surface.positions.col(0)) result.labels.push_back(x < middle ? 0 : 1);
    return result;
  }
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
};

class Strategy_threads : public testing::TestWithParam<Mode> {
 protected:
  Detector<Halves> detector(const Halves& strategy, std::size_t threads) {
    Detector<Halves> result({.mode = GetParam(), .particles = 2, .threads = threads}, strategy);
    for (const auto& mesh : scene_) result.add(std::as_const(mesh));
    return result;
  }

  std::deque<Surface_mesh> scene_{sphere(20), sphere(20, 1, {1.6, 0.1, 0.2})};
};

TEST_P(Strategy_threads, one_that_allows_it_divides_objects_side_by_side) {
  for (const std::size_t threads : {2, 5}) {
    const Halves strategy{.is_concurrent = true};
    strategy.calls->awaited = 2;
    detector(strategy, threads).detect();
    EXPECT_EQ(strategy.calls->most_running, 2U);
    EXPECT_EQ(strategy.calls->threads.size(), 2U);
  }
}

TEST_P(Strategy_threads, one_that_does_not_is_called_by_the_thread_that_asks) {
  const Halves strategy{.is_concurrent = false};
  strategy.calls->awaited = 2;
  strategy.calls->patience = std::chrono::milliseconds(100);
  detector(strategy, 5).detect();
  EXPECT_EQ(strategy.calls->most_running, 1U);
  EXPECT_EQ(strategy.calls->threads, std::set{std::this_thread::get_id()});
}

TEST_P(Strategy_threads, a_single_thread_divides_one_object_after_the_other) {
  const Halves strategy{.is_concurrent = true};
  detector(strategy, 1).detect();
  EXPECT_EQ(strategy.calls->threads, std::set{std::this_thread::get_id()});
  EXPECT_EQ(strategy.calls->most_running, 1U);
}

TEST_P(Strategy_threads, regions_and_frames_are_the_same_whether_it_is_allowed_or_not) {
  auto expected = detector({.is_concurrent = false}, 1);
  const Frame frame = expected.detect();
  EXPECT_TRUE(frame.collides());
  for (const bool is_concurrent : {false, true})
    for (const std::size_t threads : {1, 2, 5}) {
      auto found = detector({.is_concurrent = is_concurrent}, threads);
      expect_same_frame(found.detect(), frame);
      for (Object_id o = 0; o < 2; ++o) EXPECT_EQ(found.regions(o), expected.regions(o));
    }
}

TEST_P(Strategy_threads, a_surface_that_it_refuses_is_an_error_and_can_be_asked_about_again) {
  const Frame expected = detector({.is_concurrent = true}, 1).detect();
  for (const bool is_concurrent : {false, true})
    for (const std::size_t threads : {1, 2, 5}) {
      const Halves strategy{.is_concurrent = is_concurrent};
      auto found = detector(strategy, threads);
      strategy.calls->fail_on_second = true;
      EXPECT_EQ(message_of<Bad_argument>([&] { found.detect(); }), "object 1: halves: no");
      EXPECT_THROW(found.detect(), Bad_argument);
      EXPECT_THROW(found.regions(0), Bad_argument);  // All or none are built.
      strategy.calls->fail_on_second = false;
      expect_same_frame(found.detect(), expected);
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, Strategy_threads, testing::Values(Mode::exact, Mode::certified, Mode::particles),
                         [](const auto& mode) { return std::string(name_of(mode.param)); });

TEST(Any_strategy, is_concurrent_if_the_one_that_was_chosen_is) {
  EXPECT_TRUE(make_strategy("lbg").is_concurrent);
  EXPECT_FALSE(make_strategy("metis").is_concurrent);
  EXPECT_TRUE(Any_strategy(Halves{.is_concurrent = true}).is_concurrent);
  EXPECT_FALSE(Any_strategy(Halves{.is_concurrent = false}).is_concurrent);
}

}  // namespace
}  // namespace lodestone
