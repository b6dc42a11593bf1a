// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/algebraic_time.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace lodestone {

namespace {

using Coefficients = Integer_polynomial::Coefficients;
using Doubles = boost::container::static_vector<double, Integer_polynomial::most_coefficients>;

/// After so many steps a greatest common divisor tells whether two numbers are the same.
constexpr int quick_steps = 6;
/// Integers that no double can hold are divided by 2 to this power, again and again.
constexpr int excess_bits = 512;

/// The coefficients, divided by a power of two if they are too large.
Doubles as_doubles(Coefficients coefficients) {
  constexpr double largest = 1e300;  // sums of them do not overflow
  while (std::ranges::any_of(coefficients, [](const Integer& c) { return !(std::abs(CGAL::to_double(c)) < largest); }))
    for (Integer& value : coefficients) value >>= excess_bits;
  Doubles result;
  for (const Integer& value : coefficients) result.push_back(CGAL::to_double(value));
  return result;
}

/// The sign just after 0.
CGAL::Sign sign_after_zero(const Coefficients& coefficients) {
  for (const Integer& value : coefficients)
    if (const CGAL::Sign sign = CGAL::sign(value); sign != CGAL::ZERO) return sign;
  return CGAL::ZERO;
}

/// The sign that a polynomial has all over the open interval (0, 1), if the coefficients tell; zero: they do not.
CGAL::Sign constant_sign(const Coefficients& coefficients) {
  const Coefficients changes = descartes_coefficients(coefficients);
  return sign_changes(changes) == 0 ? sign_after_zero(coefficients) : CGAL::ZERO;
}

/// Isolates the roots of a polynomial by bisection, until Descartes' rule counts no root or one: the method of
/// \cite collins1976. It ends if no root is repeated.
///
/// The counts of two halves add up to no more than that of the whole, which is at most the degree. As that is at most
/// 3, only one half is left to be halved: roots that lie very close need a loop, not a stack.
class Isolation {
 public:
  Isolation(const Integer_polynomial& polynomial, Root_list& roots) : polynomial_(polynomial), roots_(roots) {}

  /// Appends the roots in (0, 1), ascending.
  void run() {
    Cell cell(polynomial_.in_cell({}), {});
    Root_list after;  // descending
    while (cell.count > 1) {
      const auto [first, second] = cell.halves();
      const bool is_root_between = CGAL::sign(second.local.front()) == CGAL::ZERO;
      const bool go_on_in_first = first.count > 1;
      if (go_on_in_first) {
        add_single(second, after);
        if (is_root_between) after.emplace_back(second.start);
      } else {
        add_single(first, roots_);
        if (is_root_between) roots_.emplace_back(second.start);
      }
      cell = go_on_in_first ? first : second;
    }
    add_single(cell, roots_);
    roots_.insert(roots_.end(), after.rbegin(), after.rend());
  }

 private:
  /// Where the polynomial is in a cell, and how many roots there can be in it.
  struct Cell {
    Coefficients local;
    Dyadic start;
    int count;

    Cell(Coefficients polynomial_there, Dyadic cell_start)
        : local(std::move(polynomial_there)),
          start(std::move(cell_start)),
          count(sign_changes(descartes_coefficients(local))) {}

    std::pair<Cell, Cell> halves() const {
      Coefficients half = local;
      for (std::size_t i = 0; i < half.size(); ++i) half[i] <<= static_cast<unsigned long>(half.size() - 1 - i);
      Coefficients shifted_half = half;
      shift_by_one(shifted_half);
      return {Cell(std::move(half), {2 * start.m, start.e + 1}),
              Cell(std::move(shifted_half), {2 * start.m + 1, start.e + 1})};
    }
  };

  void add_single(const Cell& cell, Root_list& roots) const {
    if (cell.count == 1) roots.emplace_back(polynomial_, cell.start, sign_after_zero(cell.local));
  }

  const Integer_polynomial& polynomial_;
  Root_list& roots_;
};

}  // namespace

Algebraic_time::Algebraic_time(Integer_polynomial polynomial, Dyadic start, CGAL::Sign sign_at_start)
    : polynomial_(std::move(polynomial)), start_(std::move(start)), sign_at_start_(sign_at_start) {
  while (!exact_ && (polynomial_.sign_at(start_) == CGAL::ZERO || polynomial_.sign_at(end()) == CGAL::ZERO)) halve();
}

void Algebraic_time::halve() {
  const Dyadic middle{2 * start_.m + 1, start_.e + 1};
  const CGAL::Sign sign = polynomial_.sign_at(middle);
  if (sign == CGAL::ZERO || sign == sign_at_start_)
    start_ = middle;
  else
    start_ = {2 * start_.m, start_.e + 1};
  exact_ = sign == CGAL::ZERO;
}

/// Takes the part of the cell in which the root is by an estimate. Halves the cell if that is wrong.
void Algebraic_time::leap() {
  constexpr int leap_bits = 32;
  Integer m = start_.m;
  m <<= static_cast<unsigned long>(leap_bits);
  m += Integer(std::floor(std::ldexp(estimate_in_cell(), leap_bits)));
  const Dyadic start{m, start_.e + leap_bits}, end{m + 1, start_.e + leap_bits};
  const CGAL::Sign at_start = polynomial_.sign_at(start), at_end = polynomial_.sign_at(end);
  exact_ = at_start == CGAL::ZERO || at_end == CGAL::ZERO;
  if (exact_)
    start_ = at_start == CGAL::ZERO ? start : end;
  else if (at_start == sign_at_start_ && at_end == -sign_at_start_)
    start_ = start;
  else
    halve();
}

/// The first steps are short, as they mostly are enough.
void Algebraic_time::narrow(int step) {
  constexpr int short_steps = 4;
  if (step < short_steps)
    halve();
  else
    leap();
}

CGAL::Sign Algebraic_time::sign_of(const Integer_polynomial& p) {
  for (int step = 0; !p.is_zero(); ++step) {
    if (exact_) return p.sign_at(start_);
    if (const CGAL::Sign sign = constant_sign(p.in_cell(start_)); sign != CGAL::ZERO) return sign;
    // If this number is no root of p, some cell around it holds none, nor does its neighbourhood in the complex plane.
    if (step == quick_steps && is_root_of(p)) return CGAL::ZERO;
    narrow(step);
  }
  return CGAL::ZERO;
}

/// A common divisor has no other root in the cell than this number, and no repeated one.
bool Algebraic_time::is_root_of(const Integer_polynomial& p) const {
  const Integer_polynomial common = greatest_common_divisor(polynomial_, p);
  return common.degree() > 0 && common.sign_at(start_) != common.sign_at(end());
}

std::strong_ordering Algebraic_time::compare(const Dyadic& number) const {
  if (exact_ || !(start_ < number)) {
    if (start_ < number) return std::strong_ordering::less;
    return exact_ && !(number < start_) ? std::strong_ordering::equal : std::strong_ordering::greater;
  }
  if (!(number < end())) return std::strong_ordering::less;
  const CGAL::Sign sign = polynomial_.sign_at(number);
  if (sign == CGAL::ZERO) return std::strong_ordering::equal;
  return sign == sign_at_start_ ? std::strong_ordering::greater : std::strong_ordering::less;
}

std::strong_ordering Algebraic_time::compare(Algebraic_time& other) {
  for (int step = 0;; ++step) {
    if (exact_) return 0 <=> other.compare(start_);
    if (other.exact_) return compare(other.start_);
    if (!(other.start_ < end())) return std::strong_ordering::less;
    if (!(start_ < other.end())) return std::strong_ordering::greater;
    // Cells that are not disjoint are nested, and each has one root. So two cells of one polynomial hold the same root.
    if (polynomial_ == other.polynomial_) return std::strong_ordering::equal;
    // The inner cell has room for one root of either polynomial.
    const bool is_inner = other.start_.e <= start_.e;
    Algebraic_time& inner = is_inner ? *this : other;
    Algebraic_time& outer = is_inner ? other : *this;
    if (step == quick_steps && inner.is_root_of(outer.polynomial_)) return std::strong_ordering::equal;
    outer.narrow(step);
  }
}

double Algebraic_time::round_up() const {
  const double low = round_down();
  return equals(low) ? low : std::nextafter(low, 2.0);
}

double Algebraic_time::rounded_up_above(double low) const {
  const double high = std::nextafter(low, 2.0);
  // To narrow a number that is so small takes long, and could underflow.
  if (low < 0x1p-60) return high - low;
  int exponent = 0;
  std::frexp(high - low, &exponent);  // a power of two
  const auto digits = static_cast<unsigned long>(42 - exponent);
  Algebraic_time narrowed = *this;
  while (!narrowed.exact_ && narrowed.start_.e < digits) narrowed.leap();
  // end - low, in units of 2^-digits, rounded up
  const Dyadic from = dyadic(low), end = narrowed.end();
  const unsigned long e = std::max({from.e, end.e, digits});
  Integer first = from.m, last = end.m;
  first <<= e - from.e;
  last <<= e - end.e;
  Integer units = last - first;
  units >>= e - digits;
  return std::min(std::ldexp(CGAL::to_double(units) + 1, -static_cast<int>(digits)), high - low);
}

/// The bits of doubles >= 0, read as integers, are in the order of the doubles. The steps from the estimate become
/// longer and longer, so an estimate that is off costs time only.
double Algebraic_time::round_down() const {
  const auto is_at_least = [&](std::uint64_t bits) { return compare(dyadic(std::bit_cast<double>(bits))) >= 0; };
  const auto one = std::bit_cast<std::uint64_t>(1.0), guess = std::bit_cast<std::uint64_t>(estimate());
  if (is_at_least(one)) return 1;
  std::uint64_t low = 0, high = one;
  if (is_at_least(guess)) {
    low = guess;
    for (std::uint64_t step = 1; low + step < high && high == one; step *= 2)
      (is_at_least(low + step) ? low : high) = low + step;
  } else {
    high = guess;
    for (std::uint64_t step = 1; low + step < high && low == 0; step *= 2)
      (is_at_least(high - step) ? low : high) = high - step;
  }
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (is_at_least(middle) ? low : high) = middle;
  }
  return std::bit_cast<double>(low);
}

/// A double in [0, 1], mostly within some units in the last place of this number, unless it is small and its cell wide.
double Algebraic_time::estimate() const {
  const double in_cell = exact_ ? 0 : estimate_in_cell();
  Integer m = start_.m;
  int exponent = -static_cast<int>(start_.e);
  for (; !std::isfinite(CGAL::to_double(m)); exponent += excess_bits) m >>= excess_bits;
  return std::min(std::ldexp(CGAL::to_double(m) + in_cell, exponent), 1.0);
}

/// Where the root may be in its cell, from 0 to less than 1. The cell is halved in floating point.
double Algebraic_time::estimate_in_cell() const {
  const auto local = as_doubles(polynomial_.in_cell(start_));
  const auto value_at = [&](double x) {
    return std::accumulate(local.rbegin(), local.rend(), 0.0, [x](double sum, double c) { return sum * x + c; });
  };
  double low = 0;
  for (double width = 0.5; width > 0x1p-53; width *= 0.5)
    if ((value_at(low + width) > 0) == (sign_at_start_ == CGAL::POSITIVE)) low += width;
  return low;
}

Root_list roots_until_one(const Integer_polynomial& p) {
  Root_list roots;
  const Integer_polynomial whole = p.primitive();
  const auto list = [&roots](const Integer_polynomial& q) { Isolation(q, roots).run(); };
  const int changes = sign_changes(descartes_coefficients(whole.in_cell({})));
  if (changes == 1)
    list(whole);  // one root, which is not repeated, whatever the others are
  else if (changes > 1)
    list(square_free(whole));
  if (const Dyadic one{1, 0}; p.sign_at(one) == CGAL::ZERO) roots.emplace_back(one);
  return roots;
}

}  // namespace lodestone
