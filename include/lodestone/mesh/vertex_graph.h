// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/range/iterator_range.hpp>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_faces.h"

namespace lodestone {

/// The edges of a mesh as a Boost.Graph: both directions of every edge, the neighbours of a vertex in ascending order.
using Vertex_graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                        boost::no_property, std::uint32_t, std::uint32_t>;

/// The edges of a surface.
struct Surface_edges {
  Vertex_graph graph;             ///< both directions of every edge
  std::vector<bool> open_border;  ///< V: whether a vertex lies on an open border, that is, on an edge of only one face
};

/// The edges of the given faces. O(V + F log d), with at most d faces at a vertex.
/// @param vertex_faces  of the same faces
Surface_edges surface_edges(const Vertex_faces& vertex_faces, std::span<const Corners> faces);

/// Graph of the edges of the given faces. The same cost.
Vertex_graph vertex_graph(std::uint32_t vertex_count, std::span<const Corners> faces);

/// Indices of the neighbours of `vertex`, ascending.
inline auto neighbours(const Vertex_graph& graph, std::uint32_t vertex) {
  return boost::make_iterator_range(adjacent_vertices(vertex, graph));
}

/// Per vertex: whether it lies on an open border, that is, on an edge of only one face. The same cost.
std::vector<bool> open_border(std::uint32_t vertex_count, std::span<const Corners> faces);

}  // namespace lodestone
