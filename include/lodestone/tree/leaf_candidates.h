// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace lodestone {

/// Below two nodes with at most so many leaves each, boxes of leaves are compared all with all: sooner done than
/// walking on, for no branch foretells which are near.
inline constexpr std::uint32_t bunch_leaves = 32;

/// Pairs of leaves below two such nodes; there is room for one more, which is written before it is known to count.
struct Leaf_candidates {
  std::uint32_t first_a, first_b;  ///< numbers of the nodes' first leaves
  std::size_t count;
  std::uint8_t a[bunch_leaves * bunch_leaves + 1], b[bunch_leaves * bunch_leaves + 1];  ///< less the first
};

}  // namespace lodestone
