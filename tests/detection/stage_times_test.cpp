// SPDX-License-Identifier: GPL-3.0-or-later
// What counts as building an object, in every mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "detection/detector_scenes.h"

namespace lodestone {
namespace {

class Build_in_mode : public testing::TestWithParam<Mode> {
 protected:
  Detector<> detector{{.mode = GetParam(), .particles = 24}};

  void expect_built(const Frame& frame, std::size_t objects) {
    EXPECT_EQ(frame.statistics.builds, objects) << "frame " << frame.number;
    EXPECT_EQ(frame.statistics.seconds.build > 0, objects > 0) << "frame " << frame.number;
    EXPECT_EQ(frame.statistics.repartitions, 0U) << "frame " << frame.number;
  }
};

INSTANTIATE_TEST_SUITE_P(modes, Build_in_mode, testing::Values(Mode::particles, Mode::senin, Mode::exact),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

TEST_P(Build_in_mode, is_a_stage_of_the_first_frame_of_an_object_alone) {
  auto scene = two_spheres(1.8);
  add_all(detector, scene);
  expect_built(detector.detect(), 2);
  for (int frame = 0; frame < 3; ++frame) {
    shift(scene[1], -0.1);
    detector.update();
    expect_built(detector.detect(), 0);
  }
  auto third = sphere(8, 1, {0, 1.5, 0});
  detector.add(third);
  expect_built(detector.detect(), 1);
  expect_built(detector.detect(), 0);
}

TEST_P(Build_in_mode, happens_again_after_a_rebuild) {
  auto scene = two_spheres(1.8);
  add_all(detector, scene);
  detector.detect();
  detector.rebuild(1);
  expect_built(detector.detect(), 1);
  expect_built(detector.detect(), 0);
}

TEST_P(Build_in_mode, leaves_nothing_out_of_the_times) {
  using Clock = std::chrono::steady_clock;
  double most = 0;  // of some attempts, since the machine may be busy
  for (int attempt = 0; attempt < 3; ++attempt) {
    auto scene = two_spheres(1.8, 60);
    Detector<> timed_detector({.mode = GetParam(), .particles = 24});
    const auto start = Clock::now();
    add_all(timed_detector, scene);
    const Stage_times seconds = timed_detector.detect().statistics.seconds;
    const double passed = std::chrono::duration<double>(Clock::now() - start).count();
    EXPECT_LE(seconds.total(), passed);
    EXPECT_GT(seconds.build, 0);
    most = std::max(most, seconds.total() / passed);
  }
  EXPECT_GT(most, 0.9);
}

TEST(Build, by_another_query_counts_in_the_next_frame) {
  auto scene = two_spheres(2.5);
  Detector<> detector({.mode = Mode::exact});
  add_all(detector, scene);
  detector.closest(0, 1);
  EXPECT_EQ(detector.detect().statistics.builds, 2U);
  EXPECT_EQ(detector.detect().statistics.builds, 0U);
}

TEST(Build, does_not_include_repartitions_of_what_has_grown) {
  auto scene = two_spheres(9);
  Detector<> detector({.mode = Mode::particles, .particles = 24});
  add_all(detector, scene);
  detector.detect();
  scale(scene[0], 3);
  detector.update();
  const auto& statistics = detector.detect().statistics;
  EXPECT_EQ(statistics.repartitions, 1U);
  EXPECT_GT(statistics.seconds.repartition, 0);
  EXPECT_EQ(statistics.builds, 0U);
  EXPECT_EQ(statistics.seconds.build, 0);
}

}  // namespace
}  // namespace lodestone
