// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <memory>
#include <optional>

#include "lodestone/triangles/moving_box.h"
#include "lodestone/triangles/triangle_intersection.h"

/// When two moving triangles meet first.
namespace lodestone {

/// A triangle whose corners move on straight lines while t goes from 0 to 1: corner i from start[i] to end[i].
struct Moving_triangle {
  Triangle start;  ///< at t = 0
  Triangle end;    ///< at t = 1
};

/// The box around a moving triangle.
Moving_box box_around(const Moving_triangle& moving);

class Algebraic_time;

/// An exact time from 0 to 1: a double, or a root of a polynomial with integer coefficients.
///
/// Comparisons are exact. They cost some nanoseconds, unless the times differ and no double lies between them, or they
/// are equal and no double: then mostly some microseconds.
class Impact_time {
 public:
  /// The time t = 0.
  Impact_time() = default;
  /// For the library's own sources.
  explicit Impact_time(const Algebraic_time& exact);
  /// For the library's own sources. Not for t = 0.
  Algebraic_time exact() const;

  /// The largest double that is not above the time.
  double low() const { return low_; }
  /// The least double that is not below the time: the same as `low`, or the next one.
  double high() const { return high_; }
  /// The nearest double; of two, the lower.
  double value() const { return value_; }
  /// For the library's own sources: how far above `low` the time is, rounded up by less than 2^-40 of what is between
  /// `low` and `high`; for times below 2^-60, all of that.
  double above_low() const { return above_low_; }

  /// Which one is earlier.
  friend std::strong_ordering operator<=>(const Impact_time& a, const Impact_time& b);
  /// Whether they are the same.
  friend bool operator==(const Impact_time& a, const Impact_time& b) { return (a <=> b) == 0; }

 private:
  double low_ = 0, high_ = 0, value_ = 0, above_low_ = 0;
  std::shared_ptr<const Algebraic_time> exact_;  ///< null: the time is a double
};

/// The first time at which two moving triangles have a point in common; touching counts. None if they never have.
///
/// Exact for any finite coordinates: every corner is where it is on the straight line between its two positions, as if
/// all numbers were rational. So nothing is missed and nothing is reported that is not so, however thin, flat or
/// degenerate the triangles are or become. The order of the triangles, and that of their corners, does not matter.
///
/// What can meet first are a corner and a triangle, or two edges; the four corners are then in one plane, at a root of
/// a cubic polynomial \cite provot1997. Its roots are isolated, and what lies where is decided at them, in integers.
/// Floating point only discards what it proves apart. Boxes around the moving corners tell triangles apart in some 10
/// to 100 ns, the signs of the polynomials in some microseconds. Each pair of features that may meet takes some
/// microseconds more; up to tenths of a second where coordinates differ by hundreds of powers of ten.
///
/// @param latest  in [0, 1]; if the first time is later than this, the result is none
std::optional<Impact_time> first_impact(const Moving_triangle& a, const Moving_triangle& b, double latest = 1);

/// The first impact of two moving triangles if it is earlier than `limit`, else none. Exact. It mostly costs less
/// than `first_impact`, since only what can be earlier is looked at.
std::optional<Impact_time> first_impact_before(const Impact_time& limit, const Moving_triangle& a,
                                               const Moving_triangle& b);
/// The first impact of two moving triangles if it is not later than `limit`, else none. As `first_impact_before`, but
/// an impact at the same time counts.
std::optional<Impact_time> first_impact_until(const Impact_time& limit, const Moving_triangle& a,
                                              const Moving_triangle& b);

}  // namespace lodestone
