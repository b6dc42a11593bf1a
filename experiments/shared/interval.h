// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace lodestone {

/// A mean with its 95 % confidence interval; `low` = `high` = `mean` for fewer than two values.
struct Interval {
  double mean = 0;
  double low = 0;
  double high = 0;
};

/// The interval of Student's t, for values of any range.
/// @param values  independent of each other, at least one
Interval mean_interval(std::span<const double> values);

/// The same for differences of proportions, which are within [-1, 1]: the interval is cut off there.
Interval difference_interval(std::span<const double> values);

/// The interval of Wilson \cite wilson1927 for a mean of proportions, within [0, 1].
///
/// Trials of one value depend on each other: frames of one scene are alike. So the number of trials is not taken as it
/// is. It is the number of independent trials whose mean would vary as much as that of the values does, as in
/// \cite korn1998, at most `trials`. Student's t with a degree of freedom less than there are values takes the place of
/// the normal quantile.
/// @param values  proportions, independent of each other, at least one
/// @param trials  of all values together; > 0
Interval proportion_interval(std::span<const double> values, double trials);

}  // namespace lodestone
