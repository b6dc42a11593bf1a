// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/moving_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestone {

namespace {

constexpr double no_overlap = std::numeric_limits<double>::infinity();

/// Eight roundings of a double: above every relative error that it bounds here.
constexpr double roundings_of_time = 0x1p-50;

/// Times in which boxes may overlap.
struct Time_range {
  double first = 0, last = 1;
};

/// The t at which the difference of two moving coordinates is zero, if it has one sign at the start and another at the
/// end. The quotient of the differences carries four roundings. Coordinates are scaled down if a difference overflows;
/// what then underflows is too small to count.
double crossing_time(double a_start, double a_end, double b_start, double b_end) {
  double start = a_start - b_start, end = a_end - b_end;
  if (!std::isfinite(start - end)) {
    constexpr double eighth = 0.125;
    start = eighth * a_start - eighth * b_start;
    end = eighth * a_end - eighth * b_end;
  }
  return start / (start - end);
}

/// Leaves of a range what surely contains all t at which coordinate a is at most coordinate b. Comparisons are exact.
void keep_not_above(double a_start, double a_end, double b_start, double b_end, Time_range& range) {
  const bool above_at_start = a_start > b_start, above_at_end = a_end > b_end;
  if (!above_at_start && !above_at_end) return;
  if (above_at_start && above_at_end) {
    range.first = no_overlap;
    return;
  }
  const double crossing = crossing_time(a_start, a_end, b_start, b_end);
  if (above_at_start)
    range.first = std::max(range.first, (1 - roundings_of_time) * crossing);
  else
    range.last = std::min(range.last, (1 + roundings_of_time) * crossing + 0x1p-1000);
}

}  // namespace

double overlap_time_lower_bound(const Moving_box& a, const Moving_box& b) {
  Time_range range;
  for (int axis = 0; axis < 3; ++axis) {
    keep_not_above(a.start.min()[axis], a.end.min()[axis], b.start.max()[axis], b.end.max()[axis], range);
    keep_not_above(b.start.min()[axis], b.end.min()[axis], a.start.max()[axis], a.end.max()[axis], range);
    if (range.first > range.last) return no_overlap;
  }
  // Below this, a relative error may be that of a subnormal number.
  return range.first < 1e-290 ? 0 : std::min(range.first, 1.0);
}

}  // namespace lodestone
