// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

/// Lanes of the widest vector that any instruction set offers: arrays have room for a whole one past their last
/// element.
namespace lodestone {

inline constexpr std::size_t widest = 8;             ///< doubles
inline constexpr std::size_t most_float_lanes = 16;  ///< floats
inline constexpr std::size_t most_box_lanes = 32;    ///< sides of boxes, 16 bits each

}  // namespace lodestone
