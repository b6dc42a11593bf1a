// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// Stands for the hops to a vertex of another component.
inline constexpr std::uint32_t unreached = std::numeric_limits<std::uint32_t>::max();

/// Hops from `source` to every vertex: the fewest edges between them, by Boost.Graph's breadth-first search. O(V + E).
/// @return V; `unreached` in other components
std::vector<std::uint32_t> breadth_first_hops(const Vertex_graph& graph, std::uint32_t source);

/// Largest hop distance between two of the given vertices.
///
/// For the particles of an object this is R_max of \cite saenghaengtham2006, the most steps that a particle can need to
/// reach another. The paper gives it approximately, by the number of vertices along the shortest route between two
/// particles. Searches breadth-first from one target after the other, until the triangle inequality bounds what is
/// left. Of one component: O(k (V + E) + k^2 n^2) for k searches, about a dozen on most surfaces, and never more than
/// O(n (V + E)), which a torus can take. Of several: the sum of that.
///
/// @param targets  n vertices of the graph
/// @return hops (dimensionless); 0 for fewer than two vertices; pairs in different components do not count
std::size_t hop_diameter(const Vertex_graph& graph, std::span<const std::uint32_t> targets);

/// How far the particles of an object may have to walk: their `hop_diameter`. One that is alone in its component may
/// have to walk all of it: there, the hops to the farthest vertex count. Cost as of `hop_diameter`.
/// @param targets  n vertices of the graph
/// @return hops (dimensionless); 0 for no vertex
std::size_t hop_reach(const Vertex_graph& graph, std::span<const std::uint32_t> targets);

/// The same as `hop_diameter`, for a mesh.
template <Triangle_mesh Mesh>
std::size_t hop_diameter(const Mesh& mesh, std::span<const Vertex<Mesh>> targets) {
  const Mesh_numbering<Mesh> numbering(mesh);
  std::vector<std::uint32_t> indices;
  for (const auto v : targets) indices.push_back(numbering.index(v));
  return hop_diameter(vertex_graph(numbering.vertex_count(), numbering.corners()), indices);
}

}  // namespace lodestone
