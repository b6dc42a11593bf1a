// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "contact/leaf_scratch.h"
#include "lodestone/contact/tree_box.h"

/// Leaf against leaf, built for several instruction sets and chosen at run time.
namespace lodestone::kernel {

/// A leaf as the kernel reads it.
struct Leaf_view {
  const double* coordinates;      ///< of the mesh
  const std::uint32_t* vertices;  ///< ascending, not empty
  const Leaf_corners* corners;
  std::size_t vertex_count;
  std::size_t face_count;
  const Tree_box* box;
};

/// Writes the face pairs of two leaves that are not proven apart, see `Leaf_pairs::near_faces`.
/// @param same  `a` and `b` are one leaf: each pair once
/// @param skip_neighbours  leave out faces that share a vertex: both leaves are of one mesh
/// @return number of pairs written to `near`, which has room for all
std::size_t near_faces(const Leaf_view& a, const Leaf_view& b, double margin, bool same, bool skip_neighbours,
                       Leaf_scratch& scratch, Face_places* near);

}  // namespace lodestone::kernel
