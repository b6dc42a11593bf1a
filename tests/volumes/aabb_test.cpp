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

TEST(Aabb, boxes_not_farther_apart_than_the_margin_are_near) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1), exponent(-60, 0);
  std::size_t far = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const double low = coordinate(random), high = low + std::exp2(exponent(random)),
                 margin = std::exp2(exponent(random));
    const double next = high + margin * (trial % 2 == 0 ? 1 : 1 + 0x1p-50);
    const bool apart = CGAL::Gmpq(next) - CGAL::Gmpq(high) > CGAL::Gmpq(margin);
    if (!near(box(low, high), box(next, 2 * std::abs(next) + 9), margin)) {
      ++far;
      ASSERT_TRUE(apart);
    }
  }
  EXPECT_GT(far, 1000U);
}

TEST(Aabb, extent_is_the_sum_of_the_sides) {
  EXPECT_EQ((Aabb{.low = {0, -1, 2, 7}, .high = {1, 1, 6, 0}}.extent()), 7);
  EXPECT_EQ(box(-1e308, 1e308).extent(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace lodestone
