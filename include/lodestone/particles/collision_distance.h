// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// How the collision distance mu is computed from a mesh.
enum class Distance_measure {
  adjacent_vertices,  ///< mean distance between vertices joined by an edge
  all_vertices,       ///< mean distance between any two vertices: about the size of the object, so it prunes nothing
};

/// The collision distance mu of \cite saenghaengtham2006, eq. (13): two particles of different objects that are nearer
/// than this make their regions a candidate. Distances are Euclidean, eq. (14). O(E) for adjacent vertices, O(V^2) for
/// all.
///
/// Eq. (13) read literally is `all_vertices`. Vertices without edges are no part of the surface and do not count.
/// @return in the units of the positions
double collision_distance(const Vertex_graph& graph, const Positions& positions,
                          Distance_measure measure = Distance_measure::adjacent_vertices);

/// The same for a mesh.
/// @param np  `vertex_point_map`
/// @throws Bad_mesh  see Mesh_numbering and read_positions
template <Triangle_mesh Mesh, class Named_parameters = CGAL::parameters::Default_named_parameters>
double collision_distance(const Mesh& mesh, Distance_measure measure = Distance_measure::adjacent_vertices,
                          const Named_parameters& np = CGAL::parameters::default_values()) {
  const Mesh_numbering<Mesh> numbering(mesh);
  return collision_distance(vertex_graph(numbering.vertex_count(), numbering.corners()),
                            read_positions(numbering, vertex_points(mesh, np)), measure);
}

}  // namespace lodestone
