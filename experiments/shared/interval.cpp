// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/interval.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

double mean_of(std::span<const double> values) {
  if (values.empty()) throw Bad_argument("the mean of no value");
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// @param values  at least two
double variance_of_mean(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / (n - 1) / n;
}

/// @param values  how many; at least two
double student_quantile(std::size_t values) {
  return quantile(boost::math::students_t(static_cast<double>(values - 1)), 0.975);
}

}  // namespace

Interval mean_interval(std::span<const double> values) {
  const double mean = mean_of(values);
  if (values.size() < 2) return {mean, mean, mean};
  const double half = student_quantile(values.size()) * std::sqrt(variance_of_mean(values));
  return {mean, mean - half, mean + half};
}

Interval difference_interval(std::span<const double> values) {
  const auto [mean, low, high] = mean_interval(values);
  return {mean, std::max(low, -1.0), std::min(high, 1.0)};
}

Interval proportion_interval(std::span<const double> values, double trials) {
  const double p = mean_of(values);
  if (values.size() < 2) return {p, p, p};
  if (!(trials > 0)) throw Bad_argument("a proportion of no trials");
  const double variance = variance_of_mean(values), spread = p * (1 - p);
  const double n = variance * trials > spread ? spread / variance : trials;
  const double t = student_quantile(values.size());
  const double centre = (p + t * t / (2 * n)) / (1 + t * t / n);
  const double half = t / (1 + t * t / n) * std::sqrt(spread / n + t * t / (4 * n * n));
  return {p, std::clamp(centre - half, 0.0, p), std::clamp(centre + half, p, 1.0)};
}

}  // namespace lodestone
