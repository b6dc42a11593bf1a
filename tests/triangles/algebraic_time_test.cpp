// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/algebraic_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "support/exact_point.h"

namespace lodestone {
namespace {

/// The polynomial q t - p, with the root p / q.
struct Factor {
  Integer p, q;

  Rational root() const { return Rational(p) / Rational(q); }
  Integer_polynomial polynomial() const { return {-p, q}; }
};

/// Roots below 0, in (0, 1], above 1, tiny, and such as differ by some 2^-100, or by less than a double can tell.
Factor any_factor(std::mt19937_64& random) {
  const auto number = [&random](int bits) { return Integer(static_cast<double>(1 + random() % (1ULL << bits))); };
  const auto large = [&](unsigned long bits) {
    Integer result = 1;
    result <<= bits;
    result += number(4);
    return result;
  };
  switch (random() % 7) {
    case 0:
      return {1, 2};
    case 1:
      return {-number(10), number(10)};
    case 2:
      return {number(3), number(4)};
    case 3:
      return {number(50), large(900)};
    case 4: {
      const Integer q = large(52);
      return {q - 3, q};
    }
    case 5: {
      const Integer q = large(1200);
      return {q - 3, q};
    }
    default: {
      const Integer p = number(53);
      return {p, number(53)};
    }
  }
}

/// A polynomial that is the product of some of them, times a number, and its roots in (0, 1].
struct Product {
  Integer_polynomial polynomial;
  std::set<Rational> roots;

  Product(const std::vector<Factor>& factors, int times)
      : polynomial(Integer_polynomial::Coefficients{Integer(times)}) {
    for (const Factor& factor : factors) {
      polynomial = polynomial * factor.polynomial();
      if (factor.root() > 0 && factor.root() <= 1) roots.insert(factor.root());
    }
  }
};

void expect_rounded(const Algebraic_time& time, const Rational& root) {
  EXPECT_LE(Rational(time.round_down()), root);
  EXPECT_GE(Rational(time.round_up()), root);
  EXPECT_EQ(time.round_up(),
            Rational(time.round_down()) == root ? time.round_down() : std::nextafter(time.round_down(), 2.0));
}

/// Compares all roots of one polynomial with all of another.
/// @return number of equal ones
std::size_t expect_ordered(const Product& a, const Product& b, const Integer_polynomial& narrows) {
  const Root_list roots_a = roots_until_one(a.polynomial), roots_b = roots_until_one(b.polynomial);
  EXPECT_EQ(roots_a.size(), a.roots.size());
  EXPECT_EQ(roots_b.size(), b.roots.size());
  if (roots_a.size() != a.roots.size() || roots_b.size() != b.roots.size()) return 0;
  std::size_t equal = 0;
  auto exact_a = a.roots.begin();
  for (const Algebraic_time& root_a : roots_a) {
    auto exact_b = b.roots.begin();
    for (const Algebraic_time& root_b : roots_b) {
      for (const bool narrow : {false, true}) {
        Algebraic_time first = root_a, second = root_b;
        if (narrow) first.sign_of(narrows);
        EXPECT_EQ(first.compare(second) < 0, *exact_a < *exact_b);
        EXPECT_EQ(first.compare(second) == 0, *exact_a == *exact_b);
        EXPECT_EQ(second.compare(first) < 0, *exact_b < *exact_a);
      }
      equal += *exact_a == *exact_b++ ? 1 : 0;
    }
    ++exact_a;
  }
  return equal;
}

TEST(Algebraic_time, of_a_product_is_a_root_of_a_factor) {
  std::mt19937_64 random(1);
  std::size_t three = 0, repeated = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    std::vector<Factor> factors(3);
    for (Factor& factor : factors) factor = any_factor(random);
    const Product product(factors, random() % 2 == 0 ? -3 : 5);
    const Root_list roots = roots_until_one(product.polynomial);
    ASSERT_EQ(roots.size(), product.roots.size());
    three += roots.size() == 3 ? 1 : 0;
    repeated += factors[0].root() == factors[1].root() ? 1 : 0;
    auto exact = product.roots.begin();
    for (const Algebraic_time& root : roots) {
      expect_rounded(root, *exact);
      const Factor other = random() % 2 == 0 ? any_factor(random) : factors[random() % 3];
      Algebraic_time narrowed = root;
      EXPECT_EQ(narrowed.sign_of(other.polynomial()), CGAL::sign(Rational(*exact - other.root())));
      expect_rounded(narrowed, *exact++);
    }
  }
  EXPECT_GT(three, 500U);
  EXPECT_GT(repeated, 50U);
}

TEST(Algebraic_time, of_two_polynomials_is_compared_exactly) {
  std::mt19937_64 random(2);
  std::size_t equal = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(trial);
    const Factor shared = any_factor(random);
    const std::vector factors{shared, any_factor(random), any_factor(random)};
    const Product a(factors, 7);
    const Product b({any_factor(random), random() % 2 == 0 ? shared : any_factor(random)}, -1);
    const Integer_polynomial narrows = any_factor(random).polynomial();
    equal += expect_ordered(a, b, narrows);
    // The same polynomial, with another sign: each root is itself and none of the others.
    EXPECT_EQ(expect_ordered(a, Product(factors, -7), narrows), a.roots.size());
  }
  EXPECT_GT(equal, 100U);
}

}  // namespace
}  // namespace lodestone
