// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "filter/filter_scratch.h"
#include "lodestone/filter/face_candidate.h"
#include "lodestone/volumes/aabb.h"

/// Leaf against leaf, built for several instruction sets and chosen at run time.
namespace lodestone::kernel {

/// A leaf as the kernel reads it.
struct Leaf_input {
  const double* coordinates;      ///< of the mesh
  const std::uint32_t* vertices;  ///< ascending, not empty; up to a vector more are read, which must be of the mesh
  const Leaf_corners* corners;
  std::size_t vertex_count;
  std::size_t face_count;
  const Aabb* box;
  Face_columns* faces;  ///< all of them where they are now, or none: then the kernel fills them in
};

/// What is asked of two leaves.
struct Filter_request {
  double margin;
  double origin[4];         ///< of rounded coordinates: finite; the nearer to the faces, the less is lost
  double scale;             ///< of them: brings sizes near 1; > 0
  float rounded_margin;     ///< in their unit, and no less than the margin
  float steps_per_unit[4];  ///< of rounded coordinates, from the origin on, for sides of boxes; 0: all are in one step
  bool one_mesh;            ///< leave out faces that share a vertex
  bool one_leaf;            ///< each pair once
};

/// Writes the face pairs of two leaves that are not proven apart, see `Face_filter::face_candidates`.
/// @return number of pairs written to `near`, which has room for all and `most_float_lanes` more
std::size_t face_candidates(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                            Filter_scratch& scratch, Face_candidate* near);

}  // namespace lodestone::kernel
