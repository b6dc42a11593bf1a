// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/double_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/exact_point.h"

namespace lodestone {
namespace {

/// The parts are not visible, but the first is the nearest double.
Rational exact(const Double_double& x) {
  const double high(x);
  return Rational(high) + Rational(static_cast<double>(x - Double_double(high)));
}

Rational bound(int exponent, const Rational& size) { return Rational(std::ldexp(1.0, exponent)) * CGAL::abs(size); }

TEST(Double_double, has_the_errors_that_are_promised) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 60);
  const auto number = [&] {
    const double high = std::ldexp(unit(random), exponent(random));
    return Double_double(high) + Double_double(high * 0x1p-54 * unit(random));
  };
  for (int trial = 0; trial < 20000; ++trial) {
    const Double_double a = number();
    // Every other pair cancels.
    const Double_double b = trial % 2 == 0 ? number() : a * Double_double(-1 - 0x1p-50 * unit(random));
    const Rational x = exact(a), y = exact(b);
    const Rational size = CGAL::abs(x) + CGAL::abs(y);
    ASSERT_LE(CGAL::abs(Rational(exact(a + b) - (x + y))), bound(-103, size)) << trial;
    ASSERT_LE(CGAL::abs(Rational(exact(a - b) - (x - y))), bound(-103, size)) << trial;
    ASSERT_LE(CGAL::abs(Rational(exact(a * b) - x * y)), bound(-101, x * y)) << trial;
    if (y != 0) {
      ASSERT_LE(CGAL::abs(Rational(exact(a / b) - x / y)), bound(-99, x / y)) << trial;
    }
    ASSERT_EQ(a < b, x < y) << trial;
    ASSERT_EQ(exact(-a), -x) << trial;
    ASSERT_EQ(exact(abs(a)), CGAL::abs(x)) << trial;
    ASSERT_EQ(exact(times_power_of_two(a, 0x1p-70)), x * Rational(0x1p-70)) << trial;
  }
}

TEST(Double_double, has_sums_and_differences_of_doubles_without_error) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-100, 100);
  for (int trial = 0; trial < 20000; ++trial) {
    const double a = std::ldexp(unit(random), exponent(random)), b = std::ldexp(unit(random), exponent(random));
    ASSERT_EQ(exact(Double_double(a) + Double_double(b)), Rational(a) + Rational(b)) << a << ' ' << b;
    ASSERT_EQ(exact(Double_double(a) - Double_double(b)), Rational(a) - Rational(b)) << a << ' ' << b;
  }
}

TEST(Double_double, of_a_double_is_that_double) {
  for (const double x : {0.0, -1.5, 1e300, 5e-324}) EXPECT_EQ(double(Double_double(x)), x);
}

}  // namespace
}  // namespace lodestone
