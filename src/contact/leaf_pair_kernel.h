// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "contact/leaf_scratch.h"
#include "lodestone/contact/volumes/aabb.h"

/// Leaf against leaf, built for several instruction sets and chosen at run time.
namespace lodestone::kernel {

/// The corners of so many faces past a leaf's last are read, whatever they are.
inline constexpr std::size_t faces_ahead = most_box_lanes;

/// A leaf as the kernel reads it.
struct Leaf_view {
  const double* coordinates;      ///< of the mesh
  const std::uint32_t* vertices;  ///< ascending, not empty; up to a vector more are read, which must be of the mesh
  const Leaf_corners* corners;
  std::size_t vertex_count;
  std::size_t face_count;
  const Aabb* box;
  Face_columns* faces;  ///< all of them where they are now, or none: then the kernel fills them in
};

/// What is asked of two leaves.
struct Leaf_request {
  double margin;
  double origin[4];         ///< of rounded coordinates: finite; the nearer to the faces, the less is lost
  double scale;             ///< of them: brings sizes near 1; > 0
  float rounded_margin;     ///< in their unit, and no less than the margin
  float steps_per_unit[4];  ///< of rounded coordinates, from the origin on, for sides of boxes; 0: all are in one step
  bool one_mesh;            ///< leave out faces that share a vertex
  bool one_leaf;            ///< each pair once
};

/// Writes the face pairs of two leaves that are not proven apart, see `Leaf_pairs::near_faces`.
/// @return number of pairs written to `near`, which has room for all and `most_float_lanes` more
std::size_t near_faces(const Leaf_view& a, const Leaf_view& b, const Leaf_request& request, Leaf_scratch& scratch,
                       Face_places* near);

}  // namespace lodestone::kernel
