// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace lodestone {

/// Refuses to compute in an environment in which nothing can be proved. Filters and bounds rest on what IEEE 754 says
/// of rounding to nearest and of subnormal numbers. Some programs change that for a whole thread, such as game engines,
/// and libraries that were built with `-ffast-math`. O(1), some nanoseconds.
/// @throws Bad_argument  this thread rounds in another direction, or takes subnormal numbers for zero
void check_arithmetic();

}  // namespace lodestone
