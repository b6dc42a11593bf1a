// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

namespace lodestone {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace lodestone
