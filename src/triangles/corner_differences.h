// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lodestone/triangles/triangle_intersection.h"
#include "triangles/double_double.h"

namespace lodestone {

/// The differences of corners from which distance and depth of two triangles are computed.
template <class Number>
struct Corner_differences {
  using Vector = Eigen::Matrix<Number, 3, 1>;

  std::array<std::array<Vector, 3>, 3> between;  ///< [i][j]: corner i of a minus corner j of b
  std::array<Vector, 3> edges_a;                 ///< from corner i to the next
  std::array<Vector, 3> edges_b;
};

/// The differences of corners. There is no common origin, so each difference is rounded only once.
/// @param coordinate  converts a coordinate to `Number`, and may scale it
template <class Number, class Coordinate>
Corner_differences<Number> corner_differences(const Triangle& a, const Triangle& b, const Coordinate& coordinate) {
  const auto vectors = [&](const Triangle& t) {
    std::array<typename Corner_differences<Number>::Vector, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] << coordinate(t[i].x()), coordinate(t[i].y()), coordinate(t[i].z());
    return corners;
  };
  const auto p = vectors(a), q = vectors(b);
  Corner_differences<Number> d;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) d.between[i][j] = p[i] - q[j];
    d.edges_a[i] = p[(i + 1) % 3] - p[i];
    d.edges_b[i] = q[(i + 1) % 3] - q[i];
  }
  return d;
}

/// Differences times 2^-exponent, such that the largest absolute coordinate of `between` is between 2^-74 and 2^16. So
/// products of a few differences neither overflow nor lose digits that count. Each coordinate has a relative error of
/// at most 2^-53 in double and none in `Double_double`, or an absolute error below 2^-1070.
template <class Number>
struct Scaled_differences {
  Corner_differences<Number> vectors;
  int exponent = 0;
};

inline double times_power_of_two(double a, double power) { return a * power; }

template <class Number>
Scaled_differences<Number> scaled_differences(const Triangle& a, const Triangle& b) {
  const auto greatest = [](const Corner_differences<Number>& d) {
    double most = 0;
    for (const auto& row : d.between)
      for (const auto& difference : row)
        for (int axis = 0; axis < 3; ++axis) {
          const double length = std::abs(static_cast<double>(difference[axis]));
          if (!std::isfinite(length)) return std::numeric_limits<double>::infinity();  // NaN in double-double
          most = std::max(most, length);
        }
    return most;
  };
  Scaled_differences<Number> scaled{corner_differences<Number>(a, b, [](double x) { return Number(x); })};
  double size = greatest(scaled.vectors);
  // An edge is at most twice as long as the longest of `between`, so it could overflow where those do not.
  if (!(size < 0x1p1022)) {
    scaled.vectors = corner_differences<Number>(a, b, [](double x) { return Number(0.5 * x); });
    scaled.exponent = 1;
    size = greatest(scaled.vectors);
  }
  if (size == 0 || (size > 0x1p-16 && size < 0x1p16)) return scaled;
  // Without the limit the factor could overflow. The smallest size that the limit leaves is 2^-74.
  const int shift = std::max(std::ilogb(size), -1000);
  const double factor = std::ldexp(1.0, -shift);
  const auto scale = [factor](auto& vector) {
    for (int axis = 0; axis < 3; ++axis) vector[axis] = times_power_of_two(vector[axis], factor);
  };
  for (auto& row : scaled.vectors.between)
    for (auto& difference : row) scale(difference);
  for (auto* edges : {&scaled.vectors.edges_a, &scaled.vectors.edges_b})
    for (auto& edge : *edges) scale(edge);
  scaled.exponent += shift;
  return scaled;
}

}  // namespace lodestone
