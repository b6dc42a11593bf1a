// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// On which sides of a box positions lie, built for several instruction sets and chosen at run time.
namespace lodestone::kernel {

/// Writes a byte per position: bit `axis` if it lies below the box, bit 3 + `axis` if it lies above, in each axis.
/// @param coordinates  three per position
/// @param low, high    the two corners of the box
void sides_beyond(const double* coordinates, std::size_t positions, const double* low, const double* high,
                  std::uint8_t* sides);

}  // namespace lodestone::kernel
