// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Positions times a power of two that brings the largest coordinate below 1. Exact, and keeps every later product and
/// sum within range, whatever the coordinates.
inline Positions scaled_positions(const Positions& positions) {
  int exponent = 0;
  if (positions.rows() > 0) std::frexp(positions.cwiseAbs().maxCoeff(), &exponent);
  return positions.unaryExpr([exponent](double x) { return std::ldexp(x, -exponent); });
}

}  // namespace lodestone
