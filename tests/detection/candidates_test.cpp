// SPDX-License-Identifier: GPL-3.0-or-later
// The candidate regions that a frame lists, against the particles themselves.
#include <gtest/gtest.h>

#include <tuple>

#include "detection/detector_scenes.h"

namespace lodestone {
namespace {

/// Every particle pair of two objects that is nearer than so many mu, nearest first.
template <class Detector_type>
std::vector<Candidate_regions> near_particles(const Detector_type& detector, Object_pair pair,
                                              double distance_in_mu = 1) {
  const Particles &a = detector.object(pair.a).particles(), &b = detector.object(pair.b).particles();
  std::vector<Candidate_regions> near;
  for (Region_index i = 0; i < a.at.size(); ++i)
    for (Region_index j = 0; j < b.at.size(); ++j) {
      const double distance = (a.positions[i] - b.positions[j]).norm();
      if (distance < distance_in_mu * std::max(a.collision_distance, b.collision_distance))
        near.push_back({.a = pair.a, .region_a = i, .b = pair.b, .region_b = j, .distance = distance});
    }
  std::ranges::sort(near, {}, [](const auto& c) { return std::tuple(c.distance, c.region_a, c.region_b); });
  return near;
}

void expect_same(const std::vector<Candidate_regions>& found, const std::vector<Candidate_regions>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].a, expected[i].a);
    EXPECT_EQ(found[i].b, expected[i].b);
    EXPECT_EQ(found[i].region_a, expected[i].region_a);
    EXPECT_EQ(found[i].region_b, expected[i].region_b);
    EXPECT_DOUBLE_EQ(found[i].distance, expected[i].distance);
  }
}

/// Meetings of the published method: none; the predecessor has no such option.
std::size_t published(Mode mode) { return mode == Mode::particles ? 0 : Detector_options().meetings; }

Owned_meshes three_spheres() { return {sphere(8), sphere(8, 1, {1.9, 0.1, 0.2}), sphere(8, 1, {1, 1.7, 0})}; }

TEST(Candidates, listed_are_all_particle_pairs_below_the_collision_distance_in_the_order_of_the_pairs) {
  for (const Mode mode : modes)
    for (const auto contacts : {Contact_query::yes_no, Contact_query::first, Contact_query::all}) {
      Owned_meshes scene = three_spheres();
      Detector<> detector(
          {.mode = mode, .particles = 40, .meetings = published(mode), .contacts = contacts, .list_candidates = true});
      add_all(detector, scene);
      for (int frame = 0; frame < 3; ++frame) {
        const Frame& found = detector.detect();
        std::vector<Candidate_regions> expected;
        for (const auto& pair : found.pairs) {
          const auto near = near_particles(detector, {pair.a, pair.b});
          EXPECT_EQ(pair.candidates, near.size());
          expected.insert(expected.end(), near.begin(), near.end());
        }
        EXPECT_EQ(found.pairs.size(), 3U);
        EXPECT_GT(expected.size(), 3U);
        EXPECT_EQ(found.statistics.candidates, expected.size());
        expect_same(found.candidates, expected);
      }
    }
}

TEST(Candidates, of_surfaces_with_longer_and_shorter_edges_are_nearer_than_the_longer_ones) {
  for (const Mode mode : modes) {
    Owned_meshes scene{sphere(20), sphere(5, 1, {1.9, 0.1, 0.2})};
    Detector<> detector({.mode = mode, .particles = 40, .meetings = published(mode), .list_candidates = true});
    add_all(detector, scene);
    const Frame& found = detector.detect();
    const double mu[] = {detector.object(0).particles().collision_distance,
                         detector.object(1).particles().collision_distance};
    ASSERT_LT(2 * mu[0], mu[1]);
    const auto expected = near_particles(detector, {0, 1});
    EXPECT_TRUE(std::ranges::any_of(expected, [&](const auto& pair) { return pair.distance > mu[0]; }));
    expect_same(found.candidates, expected);
  }
}

TEST(Candidates, reach_as_far_as_the_collision_distance_where_objects_feel_each_other_less_far) {
  for (const Mode mode : modes) {
    Owned_meshes scene = two_spheres(5);
    const double far = 20;  // in mu
    Detector<> detector({.mode = mode,
                         .particles = 40,
                         .meetings = published(mode),
                         .collision_distance = far,
                         .list_candidates = true});
    add_all(detector, scene);
    const Frame& found = detector.detect();
    const Particles& particles = detector.object(0).particles();
    ASSERT_LT(particles.effective_radius, 3);
    ASSERT_GT(far * particles.collision_distance, 3);
    const auto expected = near_particles(detector, {0, 1}, far);
    EXPECT_FALSE(expected.empty());
    expect_same(found.candidates, expected);
  }
}

TEST(Candidates, of_the_closest_choice_is_the_nearest_of_each_pair) {
  Owned_meshes scene = three_spheres();
  Detector<> detector({.mode = Mode::particles,
                       .particles = 40,
                       .meetings = 0,
                       .candidates = Candidate_choice::closest,
                       .list_candidates = true});
  add_all(detector, scene);
  const Frame& found = detector.detect();
  std::vector<Candidate_regions> expected;
  for (const auto& pair : found.pairs) expected.push_back(near_particles(detector, {pair.a, pair.b}).at(0));
  EXPECT_EQ(expected.size(), 3U);
  expect_same(found.candidates, expected);
}

TEST(Candidates, are_listed_only_when_asked_for_and_change_nothing_else) {
  Owned_meshes scene = three_spheres(), same_scene = three_spheres();
  Detector<> silent({.mode = Mode::particles, .particles = 40}),
      listing({.mode = Mode::particles, .particles = 40, .list_candidates = true});
  add_all(silent, scene);
  add_all(listing, same_scene);
  for (int frame = 0; frame < 3; ++frame) {
    const Frame &without = silent.detect(), &with = listing.detect();
    EXPECT_TRUE(without.candidates.empty());
    EXPECT_FALSE(with.candidates.empty());
    expect_equal(without, with);
  }
}

TEST(Candidates, there_are_none_where_objects_are_far_apart_nor_in_mode_exact) {
  Owned_meshes far = two_spheres(9);
  Detector<> particles({.mode = Mode::particles, .particles = 40, .list_candidates = true});
  add_all(particles, far);
  EXPECT_TRUE(particles.detect().candidates.empty());
  Owned_meshes near = two_spheres(1.5);
  Detector<> exact({.mode = Mode::exact, .list_candidates = true});
  add_all(exact, near);
  EXPECT_TRUE(exact.detect().collides());
  EXPECT_TRUE(exact.detect().candidates.empty());
}

TEST(Candidates, of_the_last_frame_are_gone_in_the_next) {
  Owned_meshes scene = two_spheres(1.8);
  Detector<> detector({.mode = Mode::particles, .particles = 40, .list_candidates = true});
  add_all(detector, scene);
  EXPECT_FALSE(detector.detect().candidates.empty());
  for (const auto v : scene[1].vertices()) scene[1].point(v) = scene[1].point(v) + Kernel::Vector_3(9, 0, 0);
  EXPECT_TRUE(detector.detect().candidates.empty());
}

}  // namespace
}  // namespace lodestone
