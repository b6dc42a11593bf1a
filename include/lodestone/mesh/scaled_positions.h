// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Positions times a power of two, such that the largest absolute coordinate is in [0.5, 1), or 0 if all are 0. Exact
/// except for underflow. Keeps later products and sums within the range of double, whatever the size of the
/// coordinates.
inline Positions scaled_positions(const Eigen::Ref<const Positions>& positions) {
  int exponent = 0;
  if (positions.rows() > 0) std::frexp(positions.cwiseAbs().maxCoeff(), &exponent);
  constexpr int largest = 1000;  // far enough from where the factor itself overflows or underflows
  if (-largest < exponent && exponent < largest) return positions * std::ldexp(1.0, -exponent);
  return positions.unaryExpr([exponent](double x) { return std::ldexp(x, -exponent); });
}

/// The same of coordinates.
inline Positions scaled_positions(Coordinates coordinates) {
  const auto vertices = static_cast<Eigen::Index>(coordinates.size() / 3);
  const Eigen::Ref<const Positions> positions = Eigen::Map<const Positions>(coordinates.data(), vertices, 3);
  return scaled_positions(positions);
}

}  // namespace lodestone
