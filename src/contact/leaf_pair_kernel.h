// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "contact/leaf_scratch.h"
#include "lodestone/contact/volumes/aabb.h"

/// Leaf against leaf, built for several instruction sets and chosen at run time.
namespace lodestone::kernel {

/// A leaf as the kernel reads it.
struct Leaf_view {
  const double* coordinates;      ///< of the mesh
  const std::uint32_t* vertices;  ///< ascending, not empty
  const Leaf_corners* corners;
  std::size_t vertex_count;
  std::size_t face_count;
  const Aabb* box;
  Face_columns* faces;  ///< all of them where they are now, or none: then the kernel fills them in
};

/// What is asked of two leaves.
struct Leaf_request {
  double margin;
  double origin[4];  ///< of boxes: any place, finite; the nearer to the faces, the less is lost by rounding
  double scale;      ///< that brings their sizes near 1; > 0
  bool one_mesh;     ///< leave out faces that share a vertex
  bool one_leaf;     ///< each pair once
};

/// Writes the face pairs of two leaves that are not proven apart, see `Leaf_pairs::near_faces`.
/// @return number of pairs written to `near`, which has room for all and `widest` more
std::size_t near_faces(const Leaf_view& a, const Leaf_view& b, const Leaf_request& request, Leaf_scratch& scratch,
                       Face_places* near);

}  // namespace lodestone::kernel
