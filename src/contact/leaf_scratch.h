// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace lodestone {

inline constexpr std::size_t most_faces = 128;  ///< of a leaf
inline constexpr std::size_t widest = 8;        ///< doubles of the widest vector that is used

/// Memory of leaf against leaf.
struct alignas(64) Leaf_scratch {
  /// A leaf's vertices, copied next to each other, four lanes each; and its faces near the other leaf.
  struct Side {
    alignas(32) double positions[3 * most_faces][4];
    std::uint8_t outcodes[3 * most_faces];  ///< one bit per side of a box that the vertex lies beyond
    std::uint16_t places[most_faces + 1];   ///< of the faces near the other leaf
    alignas(32) double low[most_faces][4];  ///< of their boxes
    alignas(32) double high[most_faces][4];
  };
  Side a, b;
  /// Boxes of the faces of b by coordinate, filled up with empty ones.
  double low[3][most_faces + widest];
  double high[3][most_faces + widest];
};

}  // namespace lodestone
