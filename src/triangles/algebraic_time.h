// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/container/static_vector.hpp>
#include <compare>

#include "triangles/integer_polynomial.h"

namespace lodestone {

/// A number in (0, 1] that is a root of a polynomial with integer coefficients.
///
/// It is either the dyadic number m / 2^e, or the only root in the cell, the open interval from there of width 1 / 2^e.
/// In the latter case the polynomial has opposite signs, not zero, at the ends of the cell.
class Algebraic_time {
 public:
  /// m / 2^e itself.
  explicit Algebraic_time(Dyadic value) : start_(std::move(value)), exact_(true) {}
  /// The root in a cell that has exactly one, which is simple. The ends of the cell may be roots, too.
  /// @param sign_at_start  that of the polynomial where the cell begins, before the root
  Algebraic_time(Integer_polynomial polynomial, Dyadic start, CGAL::Sign sign_at_start);

  /// Sign of a polynomial at this number. The cell becomes smaller where it must.
  CGAL::Sign sign_of(const Integer_polynomial& p);
  /// Compares with another number. Cells become smaller where they must.
  std::strong_ordering compare(Algebraic_time& other);
  std::strong_ordering compare(const Dyadic& number) const;

  /// The largest double that is not above this number.
  double round_down() const;
  /// The least double that is not below this number.
  double round_up() const;
  /// What is between a double and this number, which lies strictly between it and the next: rounded up, by less than
  /// 2^-40 of their distance unless the double is below 2^-60.
  double rounded_up_above(double low) const;
  /// Whether this number is a double, in which case `round_down` is this number.
  bool equals(double number) const { return compare(dyadic(number)) == std::strong_ordering::equal; }

 private:
  Dyadic end() const { return exact_ ? start_ : Dyadic{start_.m + 1, start_.e}; }
  void halve();
  void leap();
  void narrow(int step);
  bool is_root_of(const Integer_polynomial& p) const;
  double estimate() const;
  double estimate_in_cell() const;

  Integer_polynomial polynomial_;
  Dyadic start_;
  bool exact_ = false;
  CGAL::Sign sign_at_start_ = CGAL::ZERO;
};

using Root_list = boost::container::static_vector<Algebraic_time, Integer_polynomial::most_coefficients>;

/// All roots in (0, 1], ascending.
/// @param p  not zero, of degree 3 at most
Root_list roots_until_one(const Integer_polynomial& p);

}  // namespace lodestone
