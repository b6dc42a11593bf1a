// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/leaf_faces.h"
#include "simd/widest_vector.h"

namespace lodestone {

/// Sides of boxes are steps -32767 to 32766; the numbers beyond are left to boxes that meet nothing.
inline constexpr std::int16_t first_step = -32767;
inline constexpr float most_steps = 65533;  ///< from the first to the last

/// Boxes of faces by side, so that a vector holds one side of several. There is room for the lanes past the last face,
/// which have boxes that meet nothing.
struct alignas(64) Box_columns {
  using Sides = std::int16_t[most_leaf_faces + most_box_lanes];
  using Places = std::uint32_t[most_leaf_faces + most_float_lanes];

  alignas(64) Sides low[3];        ///< by axis, in steps
  Sides high[3];                   ///< moved out by the margin
  std::size_t count;               ///< of faces
  alignas(64) Places vertices[3];  ///< within one mesh: the numbers of the corners in it
};

/// Where the faces of a leaf are, and the leaf itself. While the number of faces is 0, only the leaf is known, if that.
struct Face_columns : Box_columns {
  using Positions = float[3][3 * most_leaf_faces + most_float_lanes];

  /// Where columns are looked up by instructions: the places of a face's vertices, ten bits each, in one number.
  alignas(64) Places corners[1];
  alignas(64) Positions positions;  ///< of the leaf's vertices: rounded, not moved
  std::int16_t low_of_leaf[4];      ///< the leaf's box, as those of faces
  std::int16_t high_of_leaf[4];
  bool knows_leaf;  ///< whether it has been filled in
};

/// Some of the faces of a leaf, by their places; there is room for a whole vector past the last.
struct Face_list {
  std::uint8_t places[most_leaf_faces + most_box_lanes];
  std::size_t count;
};

/// Some boxes of a list that one face's is near.
struct Candidate_row {
  std::uint32_t bits;    ///< one per box
  std::uint32_t places;  ///< of the face, and 256 times that in the list of the first box: bytes would be merged slowly
};

/// Memory of leaf against leaf.
struct alignas(64) Filter_scratch {
  Face_list near_a, near_b;  ///< faces near the other leaf
  Box_columns boxes;         ///< of those of one of the leaves
  Candidate_row rows[most_leaf_faces * most_leaf_faces + 1];

  /// Pairs of faces that may be near each other, by their places; there is room for a whole vector past the last.
  std::uint8_t pairs_a[most_leaf_faces * most_leaf_faces + most_box_lanes];
  std::uint8_t pairs_b[most_leaf_faces * most_leaf_faces + most_box_lanes];
};

}  // namespace lodestone
