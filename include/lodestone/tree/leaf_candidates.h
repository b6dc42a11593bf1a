// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace lodestone {

/// Most leaves below each of two nodes whose leaf boxes are compared all with all. Below that, the branches of a
/// further descent are unpredictable and cost more than the comparisons that they save.
inline constexpr std::uint32_t bunch_leaves = 32;

/// The candidate leaf pairs below two nodes with at most `bunch_leaves` leaves each.
struct Leaf_candidates {
  std::uint32_t first_a;  ///< index of the first leaf below the first node
  std::uint32_t first_b;  ///< and of that below the second
  std::size_t count;      ///< number of pairs
  /// Leaf indices, relative to the first leaf. One entry more than there can be pairs: the kernel writes each pair
  /// before it knows whether the pair counts.
  std::uint8_t a[bunch_leaves * bunch_leaves + 1];
  std::uint8_t b[bunch_leaves * bunch_leaves + 1];  ///< the same of the second node

  /// Leaf of the first tree in pair i.
  std::uint32_t leaf_a(std::size_t i) const { return first_a + a[i]; }
  /// Leaf of the second tree in pair i.
  std::uint32_t leaf_b(std::size_t i) const { return first_b + b[i]; }
};

}  // namespace lodestone
