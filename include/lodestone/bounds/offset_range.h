// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace lodestone {

/// The offsets by which one morph target moves the vertices of a node of a tree. One cache line.
struct alignas(64) Offset_range {
  std::array<double, 3> low = {};   ///< the least along x, y, z
  std::array<double, 3> high = {};  ///< the greatest
  std::uint32_t target = 0;         ///< its index
};
static_assert(sizeof(Offset_range) == 64);

}  // namespace lodestone
