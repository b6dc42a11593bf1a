// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/moving_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>

#include "support/exact_point.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

/// The first time at which two boxes overlap, in rational numbers: what is needed is a >= 0 for six linear functions.
std::optional<Rational> first_overlap(const Moving_box& a, const Moving_box& b) {
  Rational first = 0, last = 1;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool swapped : {false, true}) {
      const Moving_box &p = swapped ? b : a, &q = swapped ? a : b;
      const Rational start = Rational(q.start.max()[axis]) - Rational(p.start.min()[axis]);
      const Rational end = Rational(q.end.max()[axis]) - Rational(p.end.min()[axis]);
      if (start < 0 && end < 0) return std::nullopt;
      if (start < 0) first = std::max<Rational>(first, start / (start - end));
      if (end < 0) last = std::min<Rational>(last, start / (start - end));
    }
  if (first > last) return std::nullopt;
  return first;
}

void expect_bound(const Moving_box& a, const Moving_box& b) {
  const double bound = overlap_time_lower_bound(a, b);
  EXPECT_EQ(overlap_time_lower_bound(b, a), bound);
  const auto first = first_overlap(a, b);
  if (bound == infinity) {
    EXPECT_FALSE(first);
    return;
  }
  EXPECT_TRUE(bound >= 0 && bound <= 1);
  if (!first) return;
  EXPECT_LE(Rational(bound), *first);
  EXPECT_GE(Rational(bound) + Rational(1e-289), *first * Rational(1 - 0x1p-49));
}

class Boxes {
 public:
  explicit Boxes(double unit) : unit_(unit) {}

  Moving_box operator()() { return {box(), box()}; }

 private:
  Box box() {
    const auto point = [this] {
      const auto number = [this] { return unit_ * static_cast<double>(random_() % 13); };
      const double x = number(), y = number(), z = number();
      return Eigen::Vector3d(x, y, z);
    };
    Box result(point());
    return result.extend(result.min() + 0.25 * point());
  }

  double unit_;
  std::mt19937_64 random_{1};
};

TEST(Moving_box, overlap_is_never_before_the_bound_and_the_bound_is_sharp) {
  for (const double unit : {1.0, 0.1, 0x1p-1072, 0x1p-600, 0x1p700, 0x1p1019}) {
    Boxes boxes(unit);
    int early = 0, late = 0, none = 0;
    for (int i = 0; i < 2000; ++i) {
      const Moving_box a = boxes(), b = boxes();
      expect_bound(a, b);
      const double bound = overlap_time_lower_bound(a, b);
      ++(bound == 0 ? early : bound == infinity ? none : late);
    }
    EXPECT_GT(early, 20);
    EXPECT_GT(late, 200);
    EXPECT_GT(none, 200);
  }
}

TEST(Moving_box, far_apart_in_size_is_bounded) {
  const auto point = [](double x) { return Box(Eigen::Vector3d(x, 0, 0)); };
  const double large = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  const Moving_box still{point(0), point(0)};
  for (const double from : {-large, -1.0, -least})
    for (const double to : {least, 1.0, large}) expect_bound({point(from), point(to)}, still);
  expect_bound({point(-large), point(large)}, {point(large), point(-large)});
  EXPECT_EQ(overlap_time_lower_bound({point(-large), point(-least)}, still), infinity);
  EXPECT_EQ(overlap_time_lower_bound({point(-large), point(0)}, still), 1 - 0x1p-50);
}

TEST(Moving_box, that_comes_along_one_axis_when_it_leaves_along_another_overlaps_for_an_instant) {
  // Both happen at 1/3. The times are quotients of numbers that were rounded, and so may differ.
  std::mt19937_64 random(1);
  const auto number = [&] { return std::uniform_real_distribution<double>(1, 2)(random); };
  const auto box = [](double x, double y) { return Box(Eigen::Vector3d(x, y, 0), Eigen::Vector3d(x, y, 1)); };
  const Moving_box still{Box(Eigen::Vector3d(-9, -9, 0), Eigen::Vector3d(0, 0, 1)),
                         Box(Eigen::Vector3d(-9, -9, 0), Eigen::Vector3d(0, 0, 1))};
  for (int trial = 0; trial < 1000; ++trial) {
    const double x = number(), y = number();
    const Moving_box moving{box(x, -y), box(-2 * x, 2 * y)};
    ASSERT_EQ(first_overlap(moving, still), Rational(1) / 3);
    expect_bound(moving, still);
    EXPECT_LT(overlap_time_lower_bound(moving, still), infinity);
  }
}

}  // namespace
}  // namespace lodestone
