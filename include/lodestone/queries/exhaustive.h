// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/pairs.h"

/// Exhaustive checking: the truth that every mode is compared with.
namespace lodestone {

/// All intersecting face pairs of two sets of triangles, sorted: `CGAL::box_intersection_d` over all faces, then
/// `triangles_intersect`. O(n log^3 n + overlapping boxes).
/// @param positions_a, positions_b  V x 3, all finite
std::vector<Face_pair> exhaustive_numbered(const Positions& positions_a, std::span<const Corners> faces_a,
                                           const Positions& positions_b, std::span<const Corners> faces_b);

/// All intersecting face pairs of two meshes, sorted; the index of a face is its rank in `faces(mesh)`.
/// @param np_a, np_b  `vertex_point_map`
/// @throws Bad_mesh  a mesh has no face, a face that is not a triangle, or a coordinate that is not finite
template <Triangle_mesh Mesh_a, Triangle_mesh Mesh_b, class Parameters_a = CGAL::parameters::Default_named_parameters,
          class Parameters_b = CGAL::parameters::Default_named_parameters>
std::vector<Face_pair> exhaustive_face_pairs(const Mesh_a& a, const Mesh_b& b,
                                             const Parameters_a& np_a = CGAL::parameters::default_values(),
                                             const Parameters_b& np_b = CGAL::parameters::default_values()) {
  const Mesh_numbering<Mesh_a> numbering_a(a);
  const Mesh_numbering<Mesh_b> numbering_b(b);
  return exhaustive_numbered(read_positions(numbering_a, vertex_points(a, np_a)), numbering_a.corners(),
                             read_positions(numbering_b, vertex_points(b, np_b)), numbering_b.corners());
}

}  // namespace lodestone
