// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

/// Lanes of the widest vector of any instruction set. Arrays that kernels read or write have this much padding, so that
/// a whole vector fits past their last element.
namespace lodestone {

inline constexpr std::size_t most_double_lanes = 8;
inline constexpr std::size_t most_float_lanes = 16;
inline constexpr std::size_t most_side_lanes = 32;  ///< sides of boxes, 16 bits each

}  // namespace lodestone
