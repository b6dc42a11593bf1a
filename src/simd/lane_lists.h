// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lodestone::kernel {

/// For each pattern of eight bits, the indices of the bits that are set, ascending, then zeros.
inline constexpr auto lane_lists = [] {
  std::array<std::array<std::uint8_t, 8>, 256> lists{};
  for (unsigned bits = 0; bits < lists.size(); ++bits) {
    std::size_t count = 0;
    for (std::uint8_t bit = 0; bit < 8; ++bit)
      if ((bits >> bit & 1U) != 0) lists[bits][count++] = bit;
  }
  return lists;
}();

/// 0, 1, 2, ..., 255.
inline constexpr auto every_index = [] {
  std::array<std::uint8_t, 256> indices{};
  for (unsigned index = 0; index < indices.size(); ++index) indices[index] = static_cast<std::uint8_t>(index);
  return indices;
}();

}  // namespace lodestone::kernel
