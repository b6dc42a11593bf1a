// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/interval.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "lodestone/mesh/errors.h"

namespace lodestone {

Interval confidence_interval(std::span<const double> values) {
  if (values.empty()) throw Bad_argument("the mean of no value");
  const auto n = static_cast<double>(values.size());
  Interval interval{.mean = std::accumulate(values.begin(), values.end(), 0.0) / n};
  if (values.size() < 2) return interval;
  double squares = 0;
  for (const double value : values) squares += (value - interval.mean) * (value - interval.mean);
  const double t = quantile(boost::math::students_t(n - 1), 0.975);
  interval.half_width = t * std::sqrt(squares / (n - 1) / n);
  return interval;
}

}  // namespace lodestone
