// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/quospo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/leaves.h"

namespace lodestone {
namespace {

/// As the columns of a matrix.
Eigen::Matrix3d unit_directions(const Quantised_turn& turn) {
  Eigen::Matrix3d axes;
  const auto directions = turn.directions();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) axes(k, i) = directions[i][k] / turn.length();
  return axes;
}

TEST(Quantised_turn, has_perpendicular_directions_of_its_length) {
  for (std::int16_t x = -7; x <= 7; ++x)
    for (std::int16_t y = -7; y <= 7; ++y)
      for (std::int16_t z = -7; z <= 7; ++z) {
        const Quantised_turn turn{16, x, y, z};
        const auto d = turn.directions();
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            ASSERT_EQ(d[i][0] * d[j][0] + d[i][1] * d[j][1] + d[i][2] * d[j][2],
                      i == j ? turn.length() * turn.length() : 0);
      }
}

TEST(Quospo, has_directions_within_a_few_degrees_of_those_of_any_box) {
  std::mt19937_64 random(31);
  double least = 1;
  for (int sample = 0; sample < 5000; ++sample) {
    const Eigen::Matrix3d turn = random_turn(random);
    const Eigen::Matrix3d axes = unit_directions(volume_of<Quospo>(box_corners({1, 0.5, 0.1}, turn)).turn);
    for (int i = 0; i < 3; ++i) least = std::min(least, (axes.transpose() * turn.col(i)).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(least, std::cos(6.3 / 180 * std::numbers::pi));
}

TEST(Quospo, of_a_box_along_one_of_its_frames_is_the_box) {
  for (const Quantised_turn turn : {Quantised_turn{}, {16, 2, -1, 3}, {16, -6, 5, 0}, {16, 1, 1, 1}}) {
    const auto volume = volume_of<Quospo>(box_corners({1, 0.5, 0.1}, unit_directions(turn), {1, 2, 3}));
    EXPECT_TRUE(volume.turn == turn);
    EXPECT_NEAR(volume.volume(), 8 * 0.05, 1e-12);
  }
}

TEST(Quospo, of_two_halves_of_a_box_is_the_box) {
  const Quantised_turn turn{16, 2, -1, 3};
  const Eigen::Matrix3d axes = unit_directions(turn);
  for (int axis = 0; axis < 3; ++axis) {
    Quospo both;
    const Eigen::Vector3d half(axis == 0 ? 0.5 : 1, axis == 1 ? 0.2 : 0.4, axis == 2 ? 0.05 : 0.1);
    const Eigen::Vector3d step = half[axis] * axes.col(axis);
    both.enclose(volume_of<Quospo>(box_corners(half, axes, -step)), volume_of<Quospo>(box_corners(half, axes, step)));
    EXPECT_NEAR(both.volume(), 8 * 0.04, 1e-12);
  }
}

// Two plates, one above the other in their own frame, whose upright boxes overlap.
TEST(Quospo, measures_the_margin_along_a_shared_direction) {
  const Eigen::Matrix3d axes = unit_directions({16, 2, -1, 3});
  const auto a = volume_of<Quospo>(box_corners({1, 0.8, 0.1}, axes));
  const auto b = volume_of<Quospo>(box_corners({1, 0.8, 0.1}, axes, 0.3 * axes.col(2)));
  ASSERT_TRUE(a.turn == b.turn);
  ASSERT_TRUE(near(a.bounds(), b.bounds(), 0));
  EXPECT_FALSE(near(a, b, 0));
  EXPECT_FALSE(near(a, b, 0.1 - 1e-12));
  EXPECT_TRUE(near(a, b, 0.1 + 1e-12));
}

// A slanted needle above a plate: the nearest point of the plate's upper plane is below the needle's lower end.
TEST(Quospo, measures_the_margin_along_a_direction_of_one_of_two_frames) {
  const Eigen::Matrix3d axes = unit_directions({16, 2, -1, 3}), needle_axes = unit_directions({16, -3, 5, 1});
  const Eigen::Vector3d half(0.6, 0.02, 0.01), up = axes.col(2);
  const double reach = half.dot((needle_axes.transpose() * up).cwiseAbs());
  const auto plate = volume_of<Quospo>(box_corners({1, 0.8, 0.1}, axes));
  const auto needle = volume_of<Quospo>(box_corners(half, needle_axes, (0.1 + reach + 0.05) * up));
  ASSERT_FALSE(plate.turn == needle.turn);
  ASSERT_TRUE(near(plate.bounds(), needle.bounds(), 0));
  for (const auto& [a, b] : {std::pair(plate, needle), std::pair(needle, plate)}) {
    EXPECT_FALSE(near(a, b, 0));
    EXPECT_FALSE(near(a, b, 0.05 - 1e-12));
    EXPECT_TRUE(near(a, b, 0.05 + 1e-12));
  }
}

TEST(Quospo, has_the_same_turn_at_every_size) {
  std::mt19937_64 random(32);
  const auto corners = box_corners({1, 0.6, 0.1}, random_turn(random));
  for (const int exponent : {-900, -300, 300, 900}) {
    auto scaled = corners;
    for (auto& p : scaled) p = p.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    EXPECT_TRUE(volume_of<Quospo>(scaled).turn == volume_of<Quospo>(corners).turn);
  }
}

}  // namespace
}  // namespace lodestone
