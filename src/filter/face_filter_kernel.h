// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "filter/filter_scratch.h"
#include "lodestone/filter/face_candidate.h"
#include "lodestone/volumes/aabb.h"

/// Leaf against leaf, built for several instruction sets and chosen at run time. All give the same candidates in the
/// same order.
namespace lodestone::kernel {

/// A leaf as the kernel reads it.
struct Leaf_input {
  const double* coordinates;      ///< of the mesh
  const std::uint32_t* vertices;  ///< not empty, in any order, some perhaps twice; padded with a vector of vertices
  const Leaf_corners* corners;
  std::size_t vertex_count;
  std::size_t face_count;
  const Aabb* box;
  Face_columns* faces;  ///< the kernel fills in what is missing
};

/// What is asked of two leaves.
struct Filter_request {
  double margin;
  double origin[4];         ///< of rounded coordinates; finite; the nearer to the faces, the less rounding loses
  double scale;             ///< of rounded coordinates: brings sizes near 1; > 0
  float rounded_margin;     ///< scaled, and rounded up
  float steps_per_unit[4];  ///< by axis: steps per unit of rounded coordinates; 0: every side is in the first step
  double least_side;        ///< of coordinates: a leaf with only shorter sides spans too few steps to tell faces apart
  bool one_mesh;            ///< discard pairs of faces that share a vertex
  bool one_leaf;            ///< the two leaves are the same: each pair once
};

/// Lists the face pairs of two leaves that are not proven apart, see `Face_filter::face_candidates`.
/// @param candidates  has room for all pairs and `most_float_lanes` more
/// @return number of candidates
std::size_t face_candidates(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                            Filter_scratch& scratch, Face_candidate* candidates);

}  // namespace lodestone::kernel
