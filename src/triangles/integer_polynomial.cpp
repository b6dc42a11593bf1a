// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/integer_polynomial.h"

#include <CGAL/number_utils.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lodestone {

namespace {

using Coefficients = Integer_polynomial::Coefficients;

Integer shifted(const Integer& m, unsigned long by) {
  Integer result = m;
  result <<= by;
  return result;
}

/// Remainder of a by b, times some power of the leading coefficient of b, primitive.
Integer_polynomial pseudo_remainder(Integer_polynomial a, const Integer_polynomial& b) {
  const std::size_t n = b.degree();
  while (!a.is_zero() && a.degree() >= n) {
    const std::size_t gap = a.degree() - n;
    Coefficients rest;
    for (std::size_t i = 0; i < a.degree(); ++i) {
      Integer value = a[i] * b[n];
      if (i >= gap) value -= b[i - gap] * a[a.degree()];
      rest.push_back(std::move(value));
    }
    a = Integer_polynomial(std::move(rest));
  }
  return a.primitive();
}

/// a / b, where b divides a up to a constant, primitive.
Integer_polynomial quotient(const Integer_polynomial& a, const Integer_polynomial& b) {
  const std::size_t n = b.degree(), gap = a.degree() - n;
  Coefficients rest, result(gap + 1);
  for (std::size_t i = 0; i <= a.degree(); ++i) rest.push_back(a[i]);
  for (std::size_t step = gap + 1; step-- > 0;) {
    const Integer leading = rest[step + n];
    for (auto& value : result) value *= b[n];
    result[step] = leading;
    for (std::size_t i = 0; i < step + n; ++i) rest[i] *= b[n];
    for (std::size_t i = 0; i < n; ++i) rest[step + i] -= leading * b[i];
  }
  return Integer_polynomial(std::move(result)).primitive();
}

}  // namespace

Dyadic dyadic(double number) {
  if (number == 0) return {};
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), 53));
  exponent -= 53;
  const int even = std::min(std::countr_zero(static_cast<std::uint64_t>(mantissa)), -exponent);
  mantissa >>= even;
  exponent += even;
  return {Integer(static_cast<double>(mantissa)), static_cast<unsigned long>(-exponent)};
}

bool operator<(const Dyadic& a, const Dyadic& b) {
  if (a.e < b.e) return shifted(a.m, b.e - a.e) < b.m;
  return a.m < shifted(b.m, a.e - b.e);
}

Integer_polynomial::Integer_polynomial(Coefficients coefficients) : coefficients_(std::move(coefficients)) { trim(); }

void Integer_polynomial::trim() {
  while (!coefficients_.empty() && CGAL::sign(coefficients_.back()) == CGAL::ZERO) coefficients_.pop_back();
}

CGAL::Sign Integer_polynomial::sign_at(const Dyadic& t) const {
  if (is_zero()) return CGAL::ZERO;
  Integer value = coefficients_.back();
  unsigned long shift = 0;
  for (std::size_t i = degree(); i-- > 0;) {
    shift += t.e;
    value *= t.m;
    value += shifted(coefficients_[i], shift);
  }
  return CGAL::sign(value);
}

Integer_polynomial Integer_polynomial::derivative() const {
  Coefficients result;
  for (std::size_t i = 1; i < coefficients_.size(); ++i) {
    Integer value = coefficients_[i] * Integer(static_cast<int>(i));
    result.push_back(std::move(value));
  }
  return Integer_polynomial(std::move(result));
}

Integer_polynomial Integer_polynomial::primitive() const {
  Integer divisor = 0;
  for (const Integer& value : coefficients_) divisor = CGAL::gcd(divisor, value);
  if (is_zero()) return *this;
  if (CGAL::sign(coefficients_.back()) == CGAL::NEGATIVE) divisor = -divisor;
  if (divisor == 1) return *this;
  Coefficients result;
  for (const Integer& value : coefficients_) result.push_back(CGAL::integral_division(value, divisor));
  return Integer_polynomial(std::move(result));
}

Coefficients Integer_polynomial::in_cell(const Dyadic& start) const {
  Coefficients result;
  const std::size_t n = degree();
  for (std::size_t i = 0; i < coefficients_.size(); ++i) result.push_back(shifted(coefficients_[i], start.e * (n - i)));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = n; j-- > i;) result[j] += start.m * result[j + 1];
  return result;
}

Integer_polynomial operator+(const Integer_polynomial& a, const Integer_polynomial& b) {
  if (a.coefficients_.size() < b.coefficients_.size()) return b + a;
  Integer_polynomial sum = a;
  for (std::size_t i = 0; i < b.coefficients_.size(); ++i) sum.coefficients_[i] += b.coefficients_[i];
  sum.trim();
  return sum;
}

Integer_polynomial operator-(const Integer_polynomial& a, const Integer_polynomial& b) {
  Integer_polynomial difference = a;
  difference.coefficients_.resize(std::max(a.coefficients_.size(), b.coefficients_.size()));
  for (std::size_t i = 0; i < b.coefficients_.size(); ++i) difference.coefficients_[i] -= b.coefficients_[i];
  difference.trim();
  return difference;
}

Integer_polynomial operator*(const Integer_polynomial& a, const Integer_polynomial& b) {
  Integer_polynomial product;
  if (a.is_zero() || b.is_zero()) return product;
  product.coefficients_.resize(a.degree() + b.degree() + 1);
  for (std::size_t i = 0; i <= a.degree(); ++i)
    for (std::size_t j = 0; j <= b.degree(); ++j) product.coefficients_[i + j] += a[i] * b[j];
  return product;
}

Integer_polynomial greatest_common_divisor(Integer_polynomial a, Integer_polynomial b) {
  a = a.primitive(), b = b.primitive();
  if (a.is_zero() || (!b.is_zero() && a.degree() < b.degree())) std::swap(a, b);
  while (!b.is_zero()) {
    // A constant divides everything.
    if (b.degree() == 0) return Integer_polynomial(Coefficients{Integer(1)});
    Integer_polynomial rest = pseudo_remainder(std::move(a), b);
    a = std::move(b);
    b = std::move(rest);
  }
  return a;
}

Integer_polynomial square_free(const Integer_polynomial& p) {
  if (p.degree() < 2) return p;
  const Integer_polynomial repeated = greatest_common_divisor(p, p.derivative());
  return repeated.degree() == 0 ? p : quotient(p, repeated);
}

void shift_by_one(Coefficients& coefficients) {
  for (std::size_t i = 0; i + 1 < coefficients.size(); ++i)
    for (std::size_t j = coefficients.size() - 1; j-- > i;) coefficients[j] += coefficients[j + 1];
}

Coefficients descartes_coefficients(const Coefficients& coefficients) {
  Coefficients result(coefficients.rbegin(), coefficients.rend());
  shift_by_one(result);
  return result;
}

int sign_changes(const Coefficients& coefficients) {
  int changes = 0;
  CGAL::Sign last = CGAL::ZERO;
  for (const Integer& value : coefficients) {
    const CGAL::Sign sign = CGAL::sign(value);
    if (sign == CGAL::ZERO) continue;
    if (last != CGAL::ZERO && sign != last) ++changes;
    last = sign;
  }
  return changes;
}

Moving_vector operator-(const Moving_vector& a, const Moving_vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Integer_polynomial cross(const Moving_vector& a, const Moving_vector& b, int axis) {
  const auto y = static_cast<std::size_t>((axis + 1) % 3), z = static_cast<std::size_t>((axis + 2) % 3);
  return a[y] * b[z] - a[z] * b[y];
}

Integer_polynomial dot(const Moving_vector& a, const Moving_vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace lodestone
