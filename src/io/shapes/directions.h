// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lodestone/mesh/concepts.h"

/// Angles and directions, for shapes, deformations and placements.
namespace lodestone::detail {

inline constexpr double turn = 2 * std::numbers::pi;  ///< radians
inline constexpr double degree = turn / 360;          ///< radians

/// Whether `v` is finite and not zero.
inline bool is_direction(const Kernel::Vector_3& v) {
  const double largest = std::max({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
  return largest > 0 && std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

/// `v` with length 1. Scaled first, so that no square overflows or underflows.
inline Kernel::Vector_3 unit(const Kernel::Vector_3& v) {
  const Kernel::Vector_3 scaled = v / std::max({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
  return scaled / std::sqrt(scaled.squared_length());
}

}  // namespace lodestone::detail
