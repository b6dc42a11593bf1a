// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/contact/leaf_faces.h"

namespace lodestone {

inline constexpr std::size_t widest = 8;           ///< doubles of the widest vector that is used
inline constexpr std::size_t most_box_lanes = 16;  ///< its floats

/// Some faces of a leaf by coordinate, so that a vector holds one coordinate of several. There is room for the lanes
/// past the last face, which have boxes that meet nothing.
struct alignas(64) Face_columns {
  using Column = float[most_leaf_faces + most_box_lanes];

  alignas(64) Column low[3];                                    ///< by axis: the face's box, rounded
  Column high[3];                                               ///< moved out by the margin
  std::uint32_t vertices[3][most_leaf_faces + most_box_lanes];  ///< within one mesh: its vertices, by corner
  std::size_t count;
  alignas(64) double positions[3 * most_leaf_faces][4];  ///< of the leaf's vertices; the fourth means nothing
};

/// Some of the faces of a leaf, by their places; there is room for a whole vector past the last.
struct Face_list {
  std::uint8_t places[most_leaf_faces + most_box_lanes];
  std::size_t count;
};

/// Memory of leaf against leaf.
struct alignas(64) Leaf_scratch {
  Face_list near_a, near_b;  ///< faces near the other leaf
  Face_columns b;            ///< those of b

  /// Pairs of faces whose boxes are near: a's place in its leaf, b's among those near a.
  std::uint8_t pairs_a[most_leaf_faces * most_leaf_faces + most_box_lanes];
  std::uint8_t pairs_b[most_leaf_faces * most_leaf_faces + most_box_lanes];
};

}  // namespace lodestone
