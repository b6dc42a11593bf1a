// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/queries/impact_search.h"

namespace lodestone {

/// @cond  helpers
/// A mesh by index, with the positions of its vertices at both ends of a motion.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Start, Vertex_point_map<Mesh> End>
class Numbered_motion {
 public:
  Numbered_motion(const Mesh& mesh, Start start, End end)
      : numbering_(mesh), start_(std::move(start)), end_(std::move(end)) {}

  /// Valid as long as this.
  Moving_surface surface() { return {numbering_.corners(), start_.read(numbering_), end_.read(numbering_)}; }

 private:
  Mesh_numbering<Mesh> numbering_;
  Coordinate_reader<Mesh, Start> start_;
  Coordinate_reader<Mesh, End> end_;
};

/// Checks that all coordinates are finite, then searches.
std::optional<Impact> checked_first_impact(const Moving_surface& a, const Moving_surface& b);
/// The same within one surface.
std::optional<Impact> checked_first_self_impact(const Moving_surface& surface);
/// @throws Bad_argument  the addresses are the same
void check_different(const void* a, const void* b);
/// @endcond

/// Finds when two meshes meet first, which may be of different types, with one call. Every vertex moves on a straight
/// line, from where it is in the vertex point map at t = 0 to where `end` puts it at t = 1.
///
/// The answer is exact, as if all coordinates were rational numbers. Nothing passes through between two frames: meshes
/// that touch for a moment, and are apart at both ends, have an impact. Meshes that intersect at the start have it at
/// t = 0. What one mesh does to itself is a question of its own: `find_first_self_impact`. Faces are numbered in the
/// order of `faces(mesh)`.
///
/// Two trees are built and thrown away, O(F log F); to ask again and again, keep trees: see `first_impact`.
///
/// @param end_a, end_b  vertex point maps: where the vertices are at the end
/// @param np_a, np_b    `vertex_point_map`: where they are at the start; default: the meshes' own points
/// @return the faces, the time and a point; none if the meshes do not meet
/// @throws Bad_mesh      no face, a face that is no triangle, a coordinate that is not finite, a Surface_mesh with
///                       removed elements
/// @throws Bad_argument  one mesh given twice
template <Triangle_mesh Mesh_a, Vertex_point_map<Mesh_a> End_a, Triangle_mesh Mesh_b, Vertex_point_map<Mesh_b> End_b,
          class Parameters_a = CGAL::parameters::Default_named_parameters,
          class Parameters_b = CGAL::parameters::Default_named_parameters>
std::optional<Impact> find_first_impact(const Mesh_a& a, const End_a& end_a, const Mesh_b& b, const End_b& end_b,
                                        const Parameters_a& np_a = CGAL::parameters::default_values(),
                                        const Parameters_b& np_b = CGAL::parameters::default_values()) {
  check_different(&a, &b);
  Numbered_motion motion_a(a, vertex_points(a, np_a), end_a);
  Numbered_motion motion_b(b, vertex_points(b, np_b), end_b);
  return checked_first_impact(motion_a.surface(), motion_b.surface());
}

/// Finds when two faces of one mesh that share no vertex meet first, with one call: a cloth that folds onto itself.
/// Everything else is as in `find_first_impact`. The lower of the two faces comes first.
///
/// @param end  vertex point map: where the vertices are at the end
/// @param np   `vertex_point_map`: where they are at the start; default: the mesh's own points
/// @return the faces, the time and a point; none if there are no such faces. t = 0 if faces that share no vertex
///         intersect, or touch, at the start
/// @throws Bad_mesh  as `find_first_impact`
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> End, class Parameters = CGAL::parameters::Default_named_parameters>
std::optional<Impact> find_first_self_impact(const Mesh& mesh, const End& end,
                                             const Parameters& np = CGAL::parameters::default_values()) {
  Numbered_motion motion(mesh, vertex_points(mesh, np), end);
  return checked_first_self_impact(motion.surface());
}

}  // namespace lodestone
