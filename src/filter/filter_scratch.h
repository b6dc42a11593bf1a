// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "filter/face_columns.h"

namespace lodestone {

/// Some of the faces of a leaf. There is room for a whole vector past the last.
struct Face_list {
  std::uint8_t indices[most_leaf_faces + most_side_lanes];  ///< in the leaf
  std::size_t count;
};

/// One face against a vector of boxes.
struct Box_row {
  std::uint32_t bits;    ///< one per box: whether it overlaps the face's box
  std::uint32_t packed;  ///< face + 256 * index of the first box in its list; two bytes would be merged slowly
};

/// Memory for the candidates of two leaves. A cull shortens a list in place.
struct alignas(64) Filter_scratch {
  Face_list faces_a, faces_b;  ///< of either leaf, those that may meet the other leaf
  Box_columns boxes;           ///< of the faces in one of these lists
  Box_row rows[most_leaf_faces * most_leaf_faces + 1];

  /// Pairs of faces that may meet, by the indices in their leaves. There is room for a whole vector past the last.
  std::uint8_t pairs_a[most_leaf_faces * most_leaf_faces + most_side_lanes];
  std::uint8_t pairs_b[most_leaf_faces * most_leaf_faces + most_side_lanes];
};

}  // namespace lodestone
