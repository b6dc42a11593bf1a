// SPDX-License-Identifier: GPL-3.0-or-later
// The mode exact against exhaustive checking.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "detection/detector_scenes.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

constexpr std::size_t sampled_frames = 16, most_faces = 20'000;

class Exact_on_scenes : public testing::TestWithParam<const char*> {};

TEST_P(Exact_on_scenes, equals_exhaustive_checking) {
  auto scene = read_scene(std::filesystem::path(LODESTONE_DATA) / "scenes" / (std::string(GetParam()) + ".json"));
  Meshes meshes;
  std::size_t faces = 0;
  for (const auto& object : scene.objects) {
    meshes.push_back(&object.mesh);
    faces += num_faces(object.mesh);
  }
  ASSERT_LE(faces, most_faces);
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, meshes);
  std::size_t colliding = 0;
  for (std::size_t sample = 0; sample < sampled_frames; ++sample) {
    for (auto& object : scene.objects) pose(object, sample * scene.frames / sampled_frames);
    colliding += expect_exhaustive(detector.detect(), meshes);
  }
  EXPECT_GT(colliding, 0U);
}

INSTANTIATE_TEST_SUITE_P(data, Exact_on_scenes,
                         testing::Values("bodies_20", "cloth_sphere", "inflate", "spheres_1k", "spheres_5k",
                                         "teapot_sphere_1", "teapot_sphere_2", "teapot_sphere_3", "teapot_sphere_4",
                                         "teapot_sphere_5", "third_object", "torus_knots", "wrong_side"),
                         [](const auto& tested) { return std::string(tested.param); });

/// Bodies of three shapes and many sizes in a box where some of them meet.
std::deque<Surface_mesh> bodies(std::size_t count, double half_width, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-half_width, half_width), size(0.2, 0.9);
  std::deque<Surface_mesh> owned;
  for (std::size_t i = 0; i < count; ++i) {
    owned.push_back(i % 3 == 0   ? sphere(4)
                    : i % 3 == 1 ? torus_knot({.radius = 0.6, .tube = 0.1, .segments = 40, .sides = 4})
                                 : cloth(6, 6));
    scale(owned.back(), size(random));
    shift(owned.back(), place(random), place(random), place(random));
  }
  return owned;
}

TEST(Exact_detector, follows_many_objects_and_drops_only_pairs_that_do_not_intersect) {
  auto owned = bodies(40, 3, 1);
  const auto meshes = all_of(owned);
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, meshes);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> step(-0.3, 0.3);
  std::size_t colliding = 0, listed = 0;
  for (int frame = 0; frame < 8; ++frame) {
    const Frame& result = detector.detect();
    colliding += expect_exhaustive(result, meshes);
    listed += result.pairs.size();
    EXPECT_TRUE(std::ranges::is_sorted(result.pairs, {}, [](const auto& p) { return std::pair(p.a, p.b); }));
    for (auto& mesh : owned) shift(mesh, step(random), step(random), step(random));
  }
  EXPECT_GT(colliding, 60U);
  EXPECT_LT(listed, 8U * 40 * 39 / 2 / 2);  // the broad phase does its work
}

TEST(Exact_detector, a_query_tells_no_more_than_was_asked) {
  auto owned = bodies(20, 1.4, 3);
  const auto meshes = all_of(owned);
  for (const auto query : {Contact_query::yes_no, Contact_query::first}) {
    Exact_detector detector({.mode = Mode::exact, .contacts = query});
    add_all(detector, meshes);
    const Frame& frame = detector.detect();
    std::size_t colliding = 0;
    for (const auto& pair : frame.pairs) {
      const auto truth = exhaustive_face_pairs(*meshes[pair.a], *meshes[pair.b]);
      EXPECT_EQ(pair.collides, !truth.empty());
      EXPECT_EQ(pair.contacts, pair.collides && query == Contact_query::first ? 1U : 0U);
      EXPECT_TRUE(std::ranges::includes(truth, frame.contacts(pair)));
      colliding += pair.collides ? 1 : 0;
    }
    EXPECT_GT(colliding, 5U);
    EXPECT_LT(colliding, frame.pairs.size());
    EXPECT_TRUE(frame.collides());
    EXPECT_EQ(frame.face_pairs.size(), query == Contact_query::first ? colliding : 0U);
  }
}

TEST(Exact_detector, detects_a_single_pair_in_either_order) {
  auto owned = bodies(20, 1.4, 3);
  const auto meshes = all_of(owned);
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, meshes);
  std::size_t colliding = 0;
  for (const auto& [a, b] : {std::pair<Object_id, Object_id>{0, 1}, {7, 2}, {19, 18}, {4, 9}, {5, 16}, {16, 12}}) {
    for (Object_id other = 0; other < 20; ++other) {
      if (other == a) continue;
      const Frame& frame = detector.detect(a, other);
      ASSERT_LE(frame.pairs.size(), 1U);
      const auto [low, high] = std::minmax(a, other);
      const auto truth = exhaustive_face_pairs(*meshes[low], *meshes[high]);
      expect_contacts(frame, low, high, truth);
      colliding += truth.empty() ? 0 : 1;
    }
    shift(owned[b], 0.1, 0.2, -0.1);
  }
  EXPECT_GT(colliding, 5U);
}

TEST(Exact_detector, lists_at_most_so_many_contacts_and_says_when_there_are_more) {
  const auto a = sphere(10), b = sphere(10, 1, {0.8, 0.1, 0.2}), c = sphere(10, 1, {9, 9, 9});
  const auto truth = exhaustive_face_pairs(a, b);
  ASSERT_GT(truth.size(), 20U);
  for (const std::size_t threads : {1, 3})
    for (const std::size_t most : {std::size_t{1}, std::size_t{2}, std::size_t{17}, truth.size() - 1, truth.size(),
                                   truth.size() + 1, std::numeric_limits<std::size_t>::max()}) {
      Exact_detector detector({.mode = Mode::exact, .most_contacts = most, .threads = threads});
      add_all(detector, {&a, &b, &c});
      const Frame& frame = detector.detect();
      ASSERT_EQ(frame.pairs.size(), 1U);
      EXPECT_TRUE(frame.pairs[0].collides);
      EXPECT_EQ(frame.pairs[0].contacts, std::min(most, truth.size()));
      EXPECT_EQ(frame.pairs[0].capped, truth.size() > most) << most;
      EXPECT_EQ(frame.capped(), truth.size() > most);
      EXPECT_TRUE(std::ranges::is_sorted(frame.face_pairs));
      EXPECT_TRUE(std::ranges::includes(truth, frame.face_pairs));
    }
}

TEST(Exact_detector, a_visitor_sees_what_is_within_the_tolerance_until_it_stops) {
  auto a = sphere(10), b = sphere(10, 1, {0.8, 0.1, 0.2});
  for (const double tolerance : {0.0, 0.05}) {
    Exact_detector detector({.mode = Mode::exact, .exact = {.tolerance = tolerance}});
    add_all(detector, {&a, &b});
    const auto truth = tolerance > 0 ? near_face_pairs(a, b, tolerance) : exhaustive_face_pairs(a, b);
    for (const std::size_t most : {std::size_t{1}, std::size_t{7}, truth.size(), truth.size() + 1}) {
      std::vector<Face_pair> seen;
      const Visit ended = detector.visit(0, 1, [&](Face_pair pair) {
        seen.push_back(pair);
        return seen.size() < most ? Visit::go_on : Visit::stop;
      });
      EXPECT_EQ(ended, most <= truth.size() ? Visit::stop : Visit::go_on);
      EXPECT_EQ(seen.size(), std::min(most, truth.size()));
      std::ranges::sort(seen);
      EXPECT_TRUE(std::ranges::includes(truth, seen)) << tolerance;
    }
  }
}

TEST(Exact_detector, a_cap_counts_for_each_pair_of_objects) {
  const auto a = sphere(8), b = sphere(8, 1, {0.8, 0.1, 0.2}), c = sphere(3, 0.2, {-1, 0, 0});
  const auto many = exhaustive_face_pairs(a, b), few = exhaustive_face_pairs(a, c);
  ASSERT_GT(few.size(), 0U);
  ASSERT_GT(many.size(), few.size());
  Exact_detector detector({.mode = Mode::exact, .most_contacts = few.size()});
  add_all(detector, {&a, &b, &c});
  const Frame& frame = detector.detect();
  EXPECT_EQ(contacts_of(frame, 0, 2), few);
  EXPECT_EQ(contacts_of(frame, 0, 1).size(), few.size());
  EXPECT_TRUE(result_of(frame, 0, 1)->capped);
  EXPECT_FALSE(result_of(frame, 0, 2)->capped);
}

TEST(Particle_detector, lists_at_most_so_many_contacts_and_says_when_there_are_more) {
  const auto a = sphere(10), b = sphere(10, 1, {0.8, 0.1, 0.2});
  const auto first_frame = [&](std::size_t most) {
    Detector<> detector({.mode = Mode::particles, .particles = 32, .most_contacts = most});
    add_all(detector, {&a, &b});
    return detector.detect();
  };
  const Frame all = first_frame(std::numeric_limits<std::size_t>::max());
  const std::size_t found = all.face_pairs.size();
  ASSERT_GT(found, 4U);
  EXPECT_FALSE(all.capped());
  for (const std::size_t most : {std::size_t{1}, std::size_t{3}, found - 1, found, found + 1}) {
    const Frame frame = first_frame(most);
    ASSERT_EQ(frame.pairs.size(), 1U);
    EXPECT_TRUE(frame.pairs[0].collides);
    EXPECT_EQ(frame.pairs[0].contacts, std::min(most, found));
    EXPECT_EQ(frame.face_pairs.size(), std::min(most, found));
    EXPECT_EQ(frame.pairs[0].capped, found > most) << most;
    EXPECT_EQ(frame.capped(), found > most);
    EXPECT_TRUE(std::ranges::includes(all.face_pairs, frame.face_pairs));
  }
}

TEST(Exact_detector, statistics_agree_with_the_frame) {
  auto owned = bodies(20, 1.4, 3);
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, all_of(owned));
  for (std::uint64_t number = 1; number < 6; ++number) {
    const Frame& frame = detector.detect();
    const auto& statistics = frame.statistics;
    EXPECT_EQ(frame.number, number);
    expect_sums_of_pairs(frame);
    EXPECT_GT(statistics.contacts, 0U);
    EXPECT_EQ(statistics.repartitions, 0U);
    EXPECT_EQ(statistics.iterations, 0U);
    EXPECT_GT(statistics.seconds.refit, 0);
    EXPECT_GT(statistics.seconds.confirmation, 0);
    EXPECT_GE(statistics.seconds.broad_phase, 0);
    EXPECT_EQ(statistics.seconds.relaxation, 0);
    EXPECT_TRUE(frame.contact_points.empty());
    EXPECT_TRUE(frame.contact_normals.empty());
    shift(owned[1], 0.1);
  }
}

TEST(Exact_detector, without_objects_or_with_one_finds_nothing) {
  Exact_detector detector({.mode = Mode::exact});
  EXPECT_TRUE(detector.detect().pairs.empty());
  const auto a = sphere(3), b = sphere(3, 1, {1, 0, 0});
  detector.add(a);
  EXPECT_TRUE(detector.detect().pairs.empty());
  detector.add(b);
  const Frame& frame = detector.detect();
  EXPECT_EQ(frame.number, 3U);
  EXPECT_EQ(expect_exhaustive(frame, {&a, &b}), 1U);
}

TEST(Exact_detector, a_frame_counts_the_vertices_that_it_has_read_once_and_no_others) {
  auto a = sphere(8), b = sphere(6, 1, {1.8, 0.1, 0});
  Exact_detector detector({.exact = {.self_collision = true}});
  add_all(detector, {&a, &b});
  const std::size_t of_a = num_vertices(a), of_b = num_vertices(b);
  EXPECT_EQ(detector.detect().statistics.vertices_read, of_a + of_b);
  EXPECT_EQ(detector.detect(0, 0).statistics.vertices_read, of_a);
  EXPECT_EQ(detector.detect(0, 1).statistics.vertices_read, of_a + of_b);
  detector.closest(0, 1), detector.within(1, 0, 0.1);  // these read them too
  EXPECT_EQ(detector.detect().statistics.vertices_read, of_a + of_b);
}

}  // namespace
}  // namespace lodestone
