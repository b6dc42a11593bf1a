// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/exact_crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/exact_point.h"

namespace lodestone {
namespace {

/// Whether a double is the nearest to a number, and nearer to zero than another that is as near.
bool is_nearest(double x, const Rational& number) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto off = [&](double other) -> Rational { return CGAL::abs(Rational(Rational(other) - number)); };
  for (const double end : {-infinity, infinity}) {
    const double other = std::nextafter(x, end);
    if (!std::isfinite(other)) continue;
    if (off(other) < off(x) || (off(other) == off(x) && std::abs(other) < std::abs(x))) return false;
  }
  return !(x == 0 && std::signbit(x));
}

/// @return whether the edge crosses the plane
bool expect_nearest(const Point& from, const Point& to, const Triangle& plane) {
  const auto corner = exact_point(plane[0]), p = exact_point(from);
  const auto normal = CGAL::cross_product(exact_point(plane[1]) - corner, exact_point(plane[2]) - corner);
  const auto edge = exact_point(to) - p;
  const Rational rise = normal * (corner - p), whole = normal * edge;
  if (CGAL::sign(rise) * CGAL::sign(Rational(whole - rise)) != CGAL::POSITIVE) return false;
  const auto exact = p + edge * Rational(rise / whole);
  const Point found = exact_crossing(from, to, plane);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_TRUE(is_nearest(found[axis], exact[axis])) << axis << ": " << std::hexfloat << found[axis];
  return true;
}

TEST(Exact_crossing, is_the_nearest_double_along_each_axis) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> small(-3, 3), exponent(-1074, 1000), near(-3, 3);
  enum Kind { anywhere, on_a_lattice, in_a_plane_but_for_rounding, of_any_size, of_any_size_along_an_axis, kinds };
  int crossings[kinds] = {};
  for (int trial = 0; trial < 15000 && !testing::Test::HasFailure(); ++trial) {
    const auto kind = static_cast<Kind>(trial % kinds);
    const double size[]{std::ldexp(1.0, exponent(random)), std::ldexp(1.0, exponent(random)),
                        std::ldexp(1.0, exponent(random))};
    const auto coordinate = [&](int axis) -> double {
      switch (kind) {
        case on_a_lattice:
          return small(random);
        case of_any_size:
          return std::ldexp(unit(random), exponent(random));
        // A few steps from a corner of a box, so that differences cancel.
        case of_any_size_along_an_axis:
          return size[axis] + near(random) * (std::nextafter(size[axis], 2 * size[axis]) - size[axis]);
        default:
          return unit(random);
      }
    };
    const auto point = [&]() -> Point {
      if (kind != in_a_plane_but_for_rounding) return {coordinate(0), coordinate(1), coordinate(2)};
      const double u = unit(random), v = unit(random);
      return {0.8 * u - 0.36 * v, 0.6 * u + 0.48 * v, 0.8 * v};
    };
    const Triangle plane{point(), point(), point()};
    crossings[kind] += expect_nearest(point(), point(), plane) ? 1 : 0;
  }
  for (const int count : crossings) EXPECT_GT(count, 100);
}

TEST(Exact_crossing, is_nearer_to_zero_of_two_that_are_as_near) {
  // Halfway between neighbouring doubles. The one nearer to zero is even in the first case, odd in the second.
  const double step = 0x1p-52;
  const Triangle plane{Point(0, -1, -1), Point(0, 1, -1), Point(0, 0, 1)};
  for (const double sign : {-1.0, 1.0})
    for (const int steps : {2, 3}) {
      const double nearer = sign * (1 + steps * step), farther = sign * (1 + (steps + 1) * step);
      EXPECT_EQ(exact_crossing(Point(-1, nearer, 0), Point(1, farther, 0), plane).y(), nearer);
      EXPECT_EQ(exact_crossing(Point(-1, farther, 0), Point(1, nearer, 0), plane).y(), nearer);
    }
}

TEST(Exact_crossing, is_right_where_the_whole_is_hardly_a_double) {
  constexpr double least = 0x1p-1074;
  EXPECT_TRUE(expect_nearest(Point(0x1.ffffffffffffap139, least, 0x1.fffffffffffdp-52),
                             Point(0x1.000000000000dp140, least, 0x1.0000000000003p-51),
                             {Point(0x1.fffffffffff68p139, 0, 0x1p-51), Point(0x1.000000000004dp140, 0, 0x1p-51),
                              Point(0x1.0000000000004p140, 5 * least, 0x1p-51)}));
}

}  // namespace
}  // namespace lodestone
