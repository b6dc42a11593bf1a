// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/leaf_faces.h"
#include "simd/widest_vector.h"

namespace lodestone {

/// The sides of boxes are counted in steps, -32767 to 32766. The two numbers beyond are for padding: boxes that overlap
/// nothing.
inline constexpr std::int16_t first_step = -32767;
inline constexpr float most_steps = 65533;  ///< from the first to the last

/// The boxes of some faces, one column per side, so that a vector holds one side of several boxes. The columns are
/// padded with boxes that overlap nothing.
struct alignas(64) Box_columns {
  using Side_column = std::int16_t[most_leaf_faces + most_side_lanes];
  using Index_column = std::uint32_t[most_leaf_faces + most_float_lanes];

  alignas(64) Side_column low[3];        ///< by axis, in steps
  Side_column high[3];                   ///< moved out by the margin
  std::size_t count;                     ///< of faces
  alignas(64) Index_column vertices[3];  ///< within one mesh only: per corner, the index of its vertex in the mesh
};

/// The faces of a leaf in columns, rounded, and the leaf's own box. Filled in when first needed: the box before the
/// faces.
struct Face_columns : Box_columns {
  using Positions = float[3][3 * most_leaf_faces + most_float_lanes];

  /// The indices of a face's three vertices in the leaf, ten bits each. Filled in only where an instruction looks up
  /// columns.
  alignas(64) Index_column corners[1];
  alignas(64) Positions positions;  ///< of the leaf's vertices, by axis: rounded, not moved by the margin
  std::int16_t leaf_low[4];         ///< the leaf's box, as those of faces
  std::int16_t leaf_high[4];
  bool has_leaf_box;
  std::array<std::uint32_t, 3> shared;  ///< Shared_vertices of the leaf; within one mesh only
  bool knows_shared;

  bool has_faces() const { return count > 0; }
  void clear() {
    count = 0;
    has_leaf_box = knows_shared = false;
  }
};

}  // namespace lodestone
