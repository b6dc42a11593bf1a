// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

namespace lodestone {

/// Rounding errors of products of coordinate differences.
///
/// With u = 2^-53, a difference of two coordinates has a relative error of at most u, and the sign of the exact
/// difference. Let the differences of a vector be at most r and those of another at most s.
///  - A component of their cross product is off by less than 9 u r s: two products, each with two inexact factors and
///    its own rounding, 3 u r s each, and the rounding of their difference.
///  - Its inner product with a third vector, of differences up to t, is off by less than 50 u r s t: for each of three
///    terms 9 u from the component, and 2 u each for factor and product since the component is up to 2 r s; and 12 u
///    for the two sums.
/// The constants below leave room for the rounding of r s t itself. The error of a subnormal product is not relative to
/// its size, so nothing is claimed unless the bounds r s and r s t are `measurable`. Then nothing overflows, and what
/// underflow can lose, below 2^-1072 times 1 or t, fits into that room.
constexpr double cross_error = 0x1p-49;   ///< 16 u, times r s
constexpr double volume_error = 0x1p-47;  ///< 64 u, times r s t

constexpr bool measurable(double bound) { return bound > 1e-290 && bound < 1e290; }

/// Tries to prove that no two faces around a vertex have a point in common except on the vertex and on edges that both
/// have. Projects along one axis first, then along the mean normal.
/// @param rim  of the vertex, with at least two faces
bool surely_spread(const double* positions, std::uint32_t vertex, std::span<const std::uint32_t> rim);

}  // namespace lodestone
