// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

namespace lodestone {

/// By how much the difference of two times that are floats can be wrong: half a step of floats for each.
/// @param last  the later one
inline double rounding_of_times(double last) {
  const auto time = static_cast<float>(std::abs(last));
  return static_cast<double>(std::nextafter(time, std::numeric_limits<float>::infinity())) - static_cast<double>(time);
}

/// A rate that follows from times that are floats: the shortest number that they leave possible, of at most six digits.
/// @param rate      > 0
/// @param rounding  by how much it may be wrong, relative to it
inline double rounded_rate(double rate, double rounding) {
  double rounded = rate;
  for (int digits = 1; digits <= 6; ++digits) {
    const double places = digits - 1 - std::floor(std::log10(rate));
    const double power = std::pow(10, std::abs(places));  // up to 1e22 exact, unlike 0.1 and its powers
    rounded = places > 0 ? std::round(rate * power) / power : std::round(rate / power) * power;
    if (std::abs(rounded - rate) <= rounding * rate) break;
  }
  return std::isfinite(rounded) && rounded > 0 ? rounded : rate;
}

}  // namespace lodestone
