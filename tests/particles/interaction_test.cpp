// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/interaction.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "support/special_numbers.h"

namespace lodestone {
namespace {

constexpr int lanes = Attractors::lanes;

/// The force on one point, computed in `lane`; the other lanes hold `other`.
double force_at(const Attractors& attractors, const Eigen::Vector3d& point, int lane = 0,
                const Eigen::Vector3d& other = {50, 60, 70}, std::ptrdiff_t but = -1) {
  std::array<double, lanes> x, y, z, force;
  for (int i = 0; i < lanes; ++i) {
    const auto& p = i == lane ? point : other;
    x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
  }
  attractors.forces(x.data(), y.data(), z.data(), force.data(), but);
  return force[lane];
}

TEST(Effective_radius, is_the_longest_distance_between_two_particles) {
  const std::vector<Eigen::Vector3d> particles{{0, 0, 0}, {3, 4, 0}, {1, 1, 1}, {0, 4, 3}};
  EXPECT_EQ(effective_radius(particles), 5);
  EXPECT_EQ(effective_radius(std::span(particles).first(1)), 0);
  EXPECT_EQ(effective_radius({}), 0);
}

TEST(Force, is_the_sum_of_inverse_squared_distances) {
  Attractors attractors;
  EXPECT_EQ(force_at(attractors, {0, 0, 0}), 0);
  attractors.add({2, 0, 0}, 100);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}), 0.25);
  attractors.add({0, 0, -4}, 100);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}), 0.25 + 0.0625);
  attractors.add({1, 1, 1}, 100);
  EXPECT_DOUBLE_EQ(force_at(attractors, {0, 0, 0}), 0.25 + 0.0625 + 1 / 3.0);
  EXPECT_EQ(attractors.size(), 3U);
}

TEST(Force, of_six_attractors_at_the_faces_of_a_cube_is_six_inverse_squares) {
  Attractors attractors;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-8.0, 8.0}) attractors.add(side * Eigen::Vector3d::Unit(axis), 1e6);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}), 6 / 64.0);
}

TEST(Force, is_zero_at_the_reach_and_beyond) {
  for (const double distance : {std::nextafter(5.0, 0.0), 5.0, std::nextafter(5.0, 6.0)}) {
    Attractors attractors;
    attractors.add({distance, 0, 0}, 25);
    EXPECT_EQ(force_at(attractors, {0, 0, 0}) > 0, distance < 5) << distance;
  }
}

TEST(Force, has_a_reach_for_each_attractor) {
  Attractors attractors;
  attractors.add({2, 0, 0}, 1);
  attractors.add({0, 4, 0}, 17);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}), 1 / 16.0);
}

TEST(Force, at_distance_0_is_infinite) {
  Attractors attractors;
  attractors.add({1, 2, 3}, 4);
  attractors.add({1, 2, 4}, 4);
  EXPECT_EQ(force_at(attractors, {1, 2, 3}), infinity);
}

TEST(Force, of_a_point_does_not_depend_on_its_lane_or_the_others) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random)); };
  Attractors attractors;
  for (int i = 0; i < 37; ++i) attractors.add(point(), 1);
  for (int trial = 0; trial < 100; ++trial) {
    const auto here = point();
    const double alone = force_at(attractors, here);
    for (int lane = 0; lane < lanes; ++lane) EXPECT_EQ(force_at(attractors, here, lane, point()), alone);
  }
}

TEST(Force, can_exclude_one_attractor) {
  Attractors attractors;
  for (const double x : {1.0, 2.0, 4.0}) attractors.add({x, 0, 0}, 100);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}, 3, {9, 9, 9}, 0), 0.25 + 0.0625);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}, 3, {9, 9, 9}, 1), 1 + 0.0625);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}, 3, {9, 9, 9}, 2), 1 + 0.25);
  EXPECT_EQ(force_at(attractors, {1, 0, 0}, 0, {9, 9, 9}, 0), 1 + 1 / 9.0);
}

TEST(Attractors, are_gone_after_clear) {
  Attractors attractors;
  attractors.add({1, 0, 0}, 100);
  attractors.clear();
  EXPECT_EQ(attractors.size(), 0U);
  EXPECT_EQ(force_at(attractors, {0, 0, 0}), 0);
}

TEST(Effective_radius, is_the_longest_distance_wherever_in_the_list_its_ends_are) {
  const std::vector<Eigen::Vector3d> particles{{0, 0, 0}, {3, 0, 0}, {-4, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(effective_radius(particles), 7);
}

}  // namespace
}  // namespace lodestone
