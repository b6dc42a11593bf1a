// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/measured_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/queries/exhaustive.h"
#include "shared/face_pair_count.h"
#include "shared/made_object.h"
#include "shared/scene_detector.h"

namespace lodestone::test {
namespace {

constexpr std::size_t frames = 9;

/// A sphere at rest, one that dives into it, and one far away.
Scene diving_spheres() {
  Scene scene;
  scene.frames = frames;
  scene.objects.push_back(made_object("still", icosphere(8), {}));
  scene.objects.push_back(
      made_object("diver", icosphere(7), {Wobble{}, Travel{.way_points = {{0, {2.6, 0, 0}}, {8, {1.5, 0.2, 0}}}}}));
  scene.objects.push_back(made_object("far", icosphere(3), {Travel{.way_points = {{0, {50, 0, 0}}}}}));
  return scene;
}

std::vector<Setting> exact_and_particles() {
  return {{"exact", {.mode = Mode::exact}}, {"particles", {.mode = Mode::particles, .particles = 32}}};
}

Measured_run measured(Scene& scene, const Measure_options& options) {
  return measure(
      {&scene, 1}, exact_and_particles(), [](std::size_t, std::size_t) {}, options);
}

TEST(Measure, both_truths_give_the_same_scores) {
  Scene scene = diving_spheres();
  const auto by_all = measured(scene, {.truth = Truth_source::exhaustive});
  const auto by_exact = measured(scene, {.truth = Truth_source::exact_mode});
  for (std::size_t s = 0; s < 2; ++s) {
    const auto &a = by_all.measurements[s].score, &b = by_exact.measurements[s].score;
    EXPECT_EQ(a.frames(), 3 * frames);
    EXPECT_EQ(a.frames(), b.frames());
    EXPECT_GT(a.positives(), 0U);
    EXPECT_LT(a.positives(), frames);
    EXPECT_EQ(a.positives(), b.positives());
    EXPECT_EQ(a.false_negatives(), b.false_negatives());
  }
  EXPECT_EQ(by_all.measurements[0].score.accuracy(), 1);
}

TEST(Measure, the_only_frame_counts) {
  Scene scene = diving_spheres();
  scene.frames = 1;
  const auto run = measured(scene, {});
  EXPECT_EQ(run.exhaustive_seconds.size(), 1U);
  for (const auto& measurement : run.measurements) EXPECT_EQ(measurement.frames.size(), 1U);
}

TEST(Median, of_an_even_number_is_between_the_two_in_the_middle) {
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(median({7}), 7);
  EXPECT_EQ(median({9, 2}), 5.5);
  EXPECT_EQ(median({9, 1, 2}), 2);
  EXPECT_EQ(median({8, 1, 9, 2}), 5);
}

TEST(Measure, scores_every_frame_of_every_play) {
  Scene scene = diving_spheres();
  const auto once = measured(scene, {});
  const auto thrice = measured(scene, {.plays = 3});
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(thrice.measurements[s].recalls.size(), 3U);
    EXPECT_EQ(thrice.measurements[s].score.frames(), 3 * once.measurements[s].score.frames());
    EXPECT_EQ(thrice.measurements[s].score.positives(), 3 * once.measurements[s].score.positives());
    EXPECT_EQ(thrice.measurements[s].frames.size(), 3 * (frames - 1));
  }
  EXPECT_EQ(thrice.measurements[1].recalls[0], once.measurements[1].recalls[0]);
}

/// Notes where the first vertex is when an object is partitioned.
struct Noting_lbg {
  static constexpr std::string_view name = "noting lbg";
  std::vector<double>* seen;

  Labelling label(const Numbered_surface& surface, std::size_t regions) const {
    seen->push_back(surface.positions(0, 0));
    return Lbg{}.label(surface, regions);
  }
};

TEST(Measure, each_play_has_partitions_made_in_the_pose_of_another_frame) {
  Scene scene;
  scene.frames = frames;
  scene.objects.push_back(made_object("ahead", icosphere(2),
                                      {Travel{.way_points = {{0, {0, 0, 0}}, {8, {8, 0, 0}}}, .path = Path::linear}}));
  const double start = scene.objects[0].mesh.points().begin()->x();
  std::vector<double> seen;
  const Setting setting{.name = "noting",
                        .options = {.mode = Mode::particles, .particles = 4},
                        .strategy = Any_strategy(Noting_lbg{&seen})};
  measure({&scene, 1}, {&setting, 1}, [](std::size_t, std::size_t) {}, {.plays = 3});
  ASSERT_EQ(seen.size(), 3U);
  for (std::size_t play = 0; play < 3; ++play) EXPECT_NEAR(seen[play], start + 3.0 * double(play), 1e-9);
}

TEST(Measure, reports_its_progress_over_the_frames_of_all_plays) {
  Scene scene = diving_spheres();
  std::size_t calls = 0;
  measure({&scene, 1}, exact_and_particles(),
          [&](std::size_t done, std::size_t of) {
            EXPECT_EQ(done, ++calls);
            EXPECT_EQ(of, 2 * frames);
          },
          {.plays = 2});
  EXPECT_EQ(calls, 2 * frames);
}

TEST(Object_pairs, are_those_that_the_scene_does_not_ignore) {
  Scene scene = diving_spheres();
  EXPECT_EQ(object_pairs(scene), (std::vector<Object_pair>{{0, 1}, {0, 2}, {1, 2}}));
  scene.ignored = {{0, 2}};
  EXPECT_EQ(object_pairs(scene), (std::vector<Object_pair>{{0, 1}, {1, 2}}));
}

TEST(Face_pair_count, exact_finds_all_face_pairs_and_particles_find_some) {
  Scene scene = diving_spheres();
  const auto counts = count_face_pairs(scene, exact_and_particles(), [](std::size_t, std::size_t) {});
  ASSERT_EQ(counts.size(), 2U);
  std::size_t all = 0;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (auto& object : scene.objects) pose(object, frame);
    all += exhaustive_face_pairs(scene.objects[0].mesh, scene.objects[1].mesh).size();
  }
  for (const auto& count : counts) EXPECT_EQ(count.all, all);
  EXPECT_EQ(counts[0].found, all);
  EXPECT_GT(counts[1].found, 0U);
  EXPECT_LE(counts[1].found, all);
}

TEST(Order_of_turns, gives_every_setting_one_turn_and_no_setting_the_same_one_before_it_in_every_frame) {
  for (const std::size_t settings : {1, 2, 3, 5, 9, 16}) {
    std::set<std::size_t> first;
    std::set<std::pair<std::size_t, std::size_t>> neighbours;  // a setting, and the one before it
    for (std::size_t frame = 0; frame < 100; ++frame) {
      const auto order = order_of_turns(frame, settings);
      EXPECT_EQ(std::set(order.begin(), order.end()).size(), settings);
      EXPECT_EQ(order.size(), settings);
      EXPECT_LT(std::ranges::max(order), settings);
      first.insert(order.front());
      for (std::size_t turn = 1; turn < settings; ++turn) neighbours.insert({order[turn], order[turn - 1]});
    }
    EXPECT_EQ(first.size(), settings);
    if (settings > 2) {
      EXPECT_GE(neighbours.size(), 2 * settings) << settings;
    }
  }
}

}  // namespace
}  // namespace lodestone::test
