// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/aabb.h"

#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace lodestone {
namespace {

Aabb box(double low, double high) {
  return {.low = {low, low, low, std::nan("")}, .high = {high, high, high, std::nan("")}};
}

TEST(Aabb, touching_boxes_are_near_along_every_axis) {
  const Aabb a = box(0, 1);
  EXPECT_TRUE(near(a, box(1, 2), 0));
  EXPECT_TRUE(near(a, box(-1, 0), 0));
  EXPECT_TRUE(near(a, box(0.25, 0.5), 0));
  for (int axis = 0; axis < 3; ++axis) {
    Aabb above = a, below = a;
    above.low[axis] = std::nextafter(1, 2), above.high[axis] = 2;
    below.high[axis] = -std::numeric_limits<double>::denorm_min(), below.low[axis] = -1;
    for (const auto& apart : {above, below}) {
      EXPECT_FALSE(near(a, apart, 0));
      EXPECT_FALSE(near(apart, a, 0));
      EXPECT_TRUE(near(a, apart, 1e-15));
      EXPECT_TRUE(near(apart, a, 1e-15));
    }
  }
}

TEST(Aabb, contains_boxes_within_its_sides_and_those_that_share_them) {
  const Aabb outer = box(0, 1);
  EXPECT_TRUE(contains(outer, outer));
  EXPECT_TRUE(contains(outer, box(0.25, 0.5)));
  for (int axis = 0; axis < 3; ++axis) {
    Aabb lower = outer, higher = outer;
    lower.low[axis] = -std::numeric_limits<double>::denorm_min();
    higher.high[axis] = std::nextafter(1, 2);
    for (const auto& inner : {lower, higher}) {
      EXPECT_FALSE(contains(outer, inner));
      EXPECT_TRUE(contains(inner, outer));
    }
  }
}

CGAL::Gmpq squared_distance(const Aabb& a, const Aabb& b) {
  CGAL::Gmpq squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const CGAL::Gmpq above = CGAL::Gmpq(a.low[axis]) - b.high[axis], below = CGAL::Gmpq(b.low[axis]) - a.high[axis];
    if (above > 0) squared += above * above;
    if (below > 0) squared += below * below;
  }
  return squared;
}

TEST(Aabb, boxes_not_farther_apart_than_the_margin_are_near) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1), exponent(-60, 0);
  std::size_t near_ones = 0, far = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const double margin = std::exp2(exponent(random)), unit = std::exp2((trial % 3 - 1) * 400.0);
    Aabb a, b;
    // Gaps along one axis, two or three, that make the margin but for rounding.
    const int axes = 1 + trial % 3;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap = axis < axes ? margin / std::sqrt(axes) * (trial % 2 == 0 ? 1 : 1 + 0x1p-40) : -0.5;
      const double low = coordinate(random), high = low + std::exp2(exponent(random));
      a.low[axis] = low * unit, a.high[axis] = high * unit;
      b.low[axis] = (high + gap) * unit, b.high[axis] = (high + gap + 1) * unit;
    }
    if (trial % 4 < 2) std::swap(a, b);
    if (near(a, b, margin * unit)) {
      ++near_ones;
    } else {
      ++far;
      ASSERT_GT(squared_distance(a, b), CGAL::Gmpq(margin * unit) * CGAL::Gmpq(margin * unit));
    }
  }
  EXPECT_GT(far, 10000U);
  EXPECT_GT(near_ones, 10000U);
}

TEST(Aabb, boxes_that_are_within_the_margin_along_every_axis_can_be_farther_apart) {
  EXPECT_FALSE(near(box(0, 1), box(1.6, 2), 1));
  EXPECT_TRUE(near(box(0, 1), box(1.57, 2), 1));
  Aabb beside = box(1.6, 2);
  beside.low[2] = 0.5;
  EXPECT_TRUE(near(box(0, 1), beside, 1));
}

TEST(Aabb, squares_that_overflow_or_underflow_do_not_part_boxes) {
  EXPECT_TRUE(near(box(0, 1), box(1e200, 2e200), 1.8e200));
  EXPECT_FALSE(near(box(0, 1), box(1e200, 2e200), 1e100));
  EXPECT_TRUE(near(box(0, 0), box(1e-200, 1), 1e-200));
}

TEST(Aabb, extent_is_the_sum_of_the_sides) {
  EXPECT_EQ((Aabb{.low = {0, -1, 2, 7}, .high = {1, 1, 6, 0}}.extent()), 7);
  EXPECT_EQ(box(-1e308, 1e308).extent(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace lodestone
