// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

/// Vectors of numbers of any type.
namespace lodestone {

template <class Number>
std::array<Number, 3> minus(const std::array<Number, 3>& p, const std::array<Number, 3>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& p, const std::array<Number, 3>& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

template <class Number>
Number dot(const std::array<Number, 3>& p, const std::array<Number, 3>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

}  // namespace lodestone
