// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace lodestone {

/// Exponent e of the power law y = c x^e that fits best: the slope of the least-squares line through the logarithms.
/// @param x, y  at least two values each, all > 0
double fitted_exponent(std::span<const double> x, std::span<const double> y);

}  // namespace lodestone
