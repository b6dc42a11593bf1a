// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_integer.h>
#include <CGAL/enum.h>

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <utility>

/// Polynomials of low degree with integer coefficients, and the numbers m / 2^e at which they are evaluated.
namespace lodestone {

using Integer = CGAL::Exact_integer;

/// The number m / 2^e.
struct Dyadic {
  Integer m = 0;
  unsigned long e = 0;
};
/// A finite double >= 0 that is at most 1, without rounding.
Dyadic dyadic(double number);
bool operator<(const Dyadic& a, const Dyadic& b);

/// A polynomial of degree 6 at most. The leading coefficient is not zero; the zero polynomial has no coefficients.
class Integer_polynomial {
 public:
  static constexpr std::size_t most_coefficients = 7;
  using Coefficients = boost::container::static_vector<Integer, most_coefficients>;

  Integer_polynomial() = default;
  /// @param coefficients  that of t^0 first
  explicit Integer_polynomial(Coefficients coefficients);
  /// The polynomial constant + slope t.
  Integer_polynomial(Integer constant, Integer slope)
      : Integer_polynomial(Coefficients{std::move(constant), std::move(slope)}) {}

  bool is_zero() const { return coefficients_.empty(); }
  /// That of the zero polynomial counts as 0.
  std::size_t degree() const { return is_zero() ? 0 : coefficients_.size() - 1; }
  const Integer& operator[](std::size_t i) const { return coefficients_[i]; }

  CGAL::Sign sign_at(const Dyadic& t) const;
  Integer_polynomial derivative() const;
  /// Divided by the greatest common divisor of the coefficients, and with a positive leading one.
  Integer_polynomial primitive() const;
  /// The coefficients of 2^(e n) p((m + x) / 2^e), n being the degree: as x goes from 0 to 1, the argument goes through
  /// the cell that starts at m / 2^e and is 1 / 2^e wide.
  Coefficients in_cell(const Dyadic& start) const;

  friend bool operator==(const Integer_polynomial& a, const Integer_polynomial& b) = default;
  friend Integer_polynomial operator+(const Integer_polynomial& a, const Integer_polynomial& b);
  friend Integer_polynomial operator-(const Integer_polynomial& a, const Integer_polynomial& b);
  friend Integer_polynomial operator*(const Integer_polynomial& a, const Integer_polynomial& b);

 private:
  void trim();

  Coefficients coefficients_;
};

/// The greatest common divisor, primitive; zero if both are zero.
Integer_polynomial greatest_common_divisor(Integer_polynomial a, Integer_polynomial b);
/// A polynomial with the same roots, each of them simple.
Integer_polynomial square_free(const Integer_polynomial& p);

/// Takes p(x) to p(x + 1).
void shift_by_one(Integer_polynomial::Coefficients& coefficients);
/// The coefficients of (1 + x)^n p(1 / (1 + x)). By Descartes' rule, p has at most as many roots in the open interval
/// (0, 1) as these have changes of sign, and fewer only by an even number.
Integer_polynomial::Coefficients descartes_coefficients(const Integer_polynomial::Coefficients& coefficients);
/// Changes of sign in a list, zeros left out.
int sign_changes(const Integer_polynomial::Coefficients& coefficients);

/// Three polynomials: a vector that moves.
using Moving_vector = std::array<Integer_polynomial, 3>;

Moving_vector operator-(const Moving_vector& a, const Moving_vector& b);
/// A component of the cross product.
Integer_polynomial cross(const Moving_vector& a, const Moving_vector& b, int axis);
Integer_polynomial dot(const Moving_vector& a, const Moving_vector& b);

}  // namespace lodestone
