// SPDX-License-Identifier: GPL-3.0-or-later
// Upper bounds of floating-point results. u = 2^-53 is the largest relative error of one operation.
#pragma once

namespace lodestone {

/// Upper bound of the exact value of x >= 0, if x was computed with at most six roundings of relative error u each:
/// x (1 + 8 u) rounded is at least x (1 + 8 u) (1 - u) > x (1 - u)^-6. Also valid for a subnormal sum of two numbers,
/// which does not round.
inline double above(double x) { return x * (1 + 0x1p-50); }

/// Whether a squared distance was computed without overflow, and with underflow far below its rounding error.
inline bool is_ordinary(double squared) { return squared >= 1e-280 && squared <= 1e280; }

/// Upper bound of the distance of two points, at most a few u above it; infinite on overflow.
double distance_above(const double* p, const double* q);

}  // namespace lodestone
