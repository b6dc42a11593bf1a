// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace lodestone {

/// A mean with its confidence interval.
struct Interval {
  double mean = 0;
  double half_width = 0;  ///< of the 95 % confidence interval, by Student's t; 0 for fewer than two values
};

/// @param values  independent of each other, at least one
Interval confidence_interval(std::span<const double> values);

}  // namespace lodestone
