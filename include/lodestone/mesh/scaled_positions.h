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

/// Coordinates as positions. Those so large or so small that products of a few of them leave the range of double are
/// scaled; all others stay as they are.
inline Positions positions_in_range(Coordinates coordinates) {
  const auto vertices = static_cast<Eigen::Index>(coordinates.size() / 3);
  const Eigen::Ref<const Positions> positions = Eigen::Map<const Positions>(coordinates.data(), vertices, 3);
  const double largest = vertices > 0 ? positions.cwiseAbs().maxCoeff() : 0;
  constexpr double most = 0x1p50;  // to the sixth power, still far from the ends of the range
  return 1 / most <= largest && largest <= most ? Positions(positions) : scaled_positions(positions);
}

}  // namespace lodestone
