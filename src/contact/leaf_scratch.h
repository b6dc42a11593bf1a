// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace lodestone {

inline constexpr std::size_t most_leaf_faces = 128;
inline constexpr std::size_t widest = 8;  ///< doubles of the widest vector that is used

/// Memory of leaf against leaf.
struct alignas(64) Leaf_scratch {
  /// A leaf's vertices, copied next to each other, four lanes each; and its faces near the other leaf.
  struct Side {
    alignas(64) double positions[3 * most_leaf_faces][4];
    std::uint8_t outcodes[3 * most_leaf_faces];  ///< one bit per side of a box that the vertex lies beyond
    std::uint16_t places[most_leaf_faces + 1];   ///< of the faces near the other leaf
  };
  Side a, b;

  /// The near faces of b by coordinate, so that a vector holds one coordinate of several; with room for the lanes past
  /// the last.
  using Column = double[most_leaf_faces + widest];
  struct alignas(64) Columns {
    Column low[3], high[3];  ///< by axis: the face's box, its high side moved out by the margin
    Column vertices[3];      ///< by corner: its number in the mesh, which a double holds without loss
  } columns;

  /// Some pairs of faces by coordinate.
  struct alignas(64) Batch {
    double a[3][3][widest];  ///< by corner and axis
    double b[3][3][widest];
  } batch;
};

}  // namespace lodestone
