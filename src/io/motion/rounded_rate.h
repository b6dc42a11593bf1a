// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace lodestone {

/// A rate with six digits: the others come from the rounding of times to floats.
/// @param rate  > 0
inline double rounded_rate(double rate) {
  const double unit = std::pow(10, 5 - std::floor(std::log10(rate)));
  const double rounded = std::round(rate * unit) / unit;
  return std::isfinite(rounded) && rounded > 0 ? rounded : rate;
}

}  // namespace lodestone
