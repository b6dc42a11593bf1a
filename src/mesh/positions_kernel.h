// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// The passes of a Box_reader over all positions, built for several instruction sets and chosen at run time. All give
/// the same results.
namespace lodestone::kernel {

/// The box around positions. If there are none, it has infinite sides, the lower one above.
/// @param coordinates  three per position
/// @param low, high    x, y, z: set to the two corners of the box
/// @return false if a coordinate is not finite; the box is then meaningless
bool bound_positions(const double* coordinates, std::size_t positions, double* low, double* high);

/// Writes a byte per position: bit `axis` if it lies below the box, bit 3 + `axis` if it lies above, in each axis.
/// @param coordinates  three per position
/// @param low, high    the two corners of the box
void sides_beyond(const double* coordinates, std::size_t positions, const double* low, const double* high,
                  std::uint8_t* sides);

}  // namespace lodestone::kernel
