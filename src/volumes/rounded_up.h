// SPDX-License-Identifier: GPL-3.0-or-later
// Upper bounds of what is computed in floating point. u = 2^-53 is the largest relative error of one operation.
#pragma once

namespace lodestone {

/// More than what was to be computed where at most six roundings, each of a relative error u, went into x >= 0: x (1 +
/// 8 u) rounded is at least x (1 + 8 u) (1 - u) > x (1 - u)^-6. Also for sums of two that are not normal numbers, for
/// these do not round.
inline double above(double x) { return x * (1 + 0x1p-50); }

/// Squared distances that are computed without overflow, and with underflow only of what is far below a rounding.
inline bool is_ordinary(double squared) { return squared >= 1e-280 && squared <= 1e280; }

/// At least the distance of two points, and at most a few u more; infinite where it is beyond all doubles.
double distance_above(const double* p, const double* q);

}  // namespace lodestone
