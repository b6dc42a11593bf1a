// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>

namespace lodestone {

/// The unevaluated sum of two doubles, `low` at most half of the last digit of `high`: some 106 bits.
///
/// If nothing overflows and products are above 2^-900 in size, the absolute error of a result is at most
///  - 0 for the sum and the difference of two doubles,
///  - 2^-103 (|a| + |b|) for a + b and a - b,
///  - 2^-101 |a b| for a b,
///  - 2^-99 |a / b| for a / b.
/// Products overflow, and are then NaN, if a factor is beyond 2^996.
/// The operations are those of \cite knuth1969 and \cite dekker1971, as in simd/double_double-inl.h.
class Double_double {
 public:
  Double_double() = default;
  /*implicit*/ Double_double(double number) : high_(number) {}

  /// The nearest double.
  explicit operator double() const { return high_; }

  friend Double_double operator+(const Double_double& a, const Double_double& b) {
    const double sum = a.high_ + b.high_, of_b = sum - a.high_;
    const double error = (a.high_ - (sum - of_b)) + (b.high_ - of_b);
    return ordered_sum(sum, error + (a.low_ + b.low_));
  }
  friend Double_double operator-(const Double_double& a) { return {-a.high_, -a.low_}; }
  friend Double_double operator-(const Double_double& a, const Double_double& b) { return a + -b; }
  friend Double_double operator*(const Double_double& a, const Double_double& b) {
    const double product = a.high_ * b.high_;
    return ordered_sum(product, product_error(a.high_, b.high_, product) + (a.high_ * b.low_ + a.low_ * b.high_));
  }
  friend Double_double operator/(const Double_double& a, const Double_double& b) {
    const double quotient = a.high_ / b.high_;
    const Double_double rest = a - quotient * b;
    return ordered_sum(quotient, rest.high_ / b.high_);
  }
  /// Without rounding, unless the result is subnormal.
  friend Double_double times_power_of_two(const Double_double& a, double power) {
    return {a.high_ * power, a.low_ * power};
  }
  Double_double& operator+=(const Double_double& b) { return *this = *this + b; }
  Double_double& operator-=(const Double_double& b) { return *this = *this - b; }
  Double_double& operator*=(const Double_double& b) { return *this = *this * b; }
  Double_double& operator/=(const Double_double& b) { return *this = *this / b; }

  friend auto operator<=>(const Double_double& a, const Double_double& b) = default;
  friend Double_double abs(const Double_double& a) { return a.high_ < 0 ? -a : a; }

 private:
  Double_double(double high, double low) : high_(high), low_(low) {}

  /// a + b without any error, for |a| >= |b| or a = 0.
  static Double_double ordered_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
  }
  /// a b - product. Halves of 26 bits each, so that their products are exact.
  static double product_error(double a, double b, double product) {
    const auto upper = [](double x) {
      const double large = (0x1p27 + 1) * x;
      return large - (large - x);
    };
    const double a1 = upper(a), a2 = a - a1, b1 = upper(b), b2 = b - b1;
    return ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
  }

  double high_ = 0, low_ = 0;
};

}  // namespace lodestone

/// What Eigen must know of a number.
template <>
struct Eigen::NumTraits<lodestone::Double_double> : Eigen::GenericNumTraits<double> {
  using Real = lodestone::Double_double;
  using NonInteger = lodestone::Double_double;
  using Nested = lodestone::Double_double;
  using Literal = double;
};
