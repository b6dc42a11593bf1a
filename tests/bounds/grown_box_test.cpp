// SPDX-License-Identifier: GPL-3.0-or-later
// The doubles next to a double.
#include "bounds/grown_box.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace lodestone {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_neighbours_of(double x) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  EXPECT_EQ(bits(next_above(x)), bits(std::nextafter(x, infinity))) << x;
  EXPECT_EQ(bits(next_below(x)), bits(std::nextafter(x, -infinity))) << x;
}

TEST(Next_double, is_that_of_nextafter) {
  using Limits = std::numeric_limits<double>;
  for (const double x : {0.0, Limits::denorm_min(), Limits::min(), 1.0, Limits::max(), infinity})
    for (const double value : {x, -x}) expect_neighbours_of(value);
  for (int power = -1074; power < 1024; ++power)
    for (const double value : {std::ldexp(1.0, power), -std::ldexp(1.0, power)}) expect_neighbours_of(value);
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i)
    if (const auto x = std::bit_cast<double>(random()); !std::isnan(x)) expect_neighbours_of(x);
  EXPECT_TRUE(std::isnan(next_above(Limits::quiet_NaN())));
  EXPECT_TRUE(std::isnan(next_below(Limits::quiet_NaN())));
}

TEST(Grown, holds_what_lies_just_outside_doubles_of_the_box) {
  const Aabb box = grown({.low = {1, 1, 1, 0}, .high = {1, 1, 1, 0}}, 0x1p-60);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(box.low[axis], 1);
    EXPECT_GT(box.high[axis], 1);
  }
}

}  // namespace
}  // namespace lodestone
