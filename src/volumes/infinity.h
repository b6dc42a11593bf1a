// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

namespace lodestone {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace lodestone
