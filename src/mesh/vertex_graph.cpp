// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/vertex_graph.h"

#include <algorithm>
#include <utility>

namespace lodestone {

Surface_edges surface_edges(const Vertex_faces& vertex_faces, std::span<const Corners> faces) {
  const std::uint32_t vertices = vertex_faces.vertex_count();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * faces.size() + vertices);  // nearly all that a surface has
  std::vector<bool> border(vertices, false);
  std::vector<std::uint32_t> others;  // the other corners of the faces at a vertex: a neighbour once per face
  for (std::uint32_t v = 0; v < vertices; ++v) {
    others.clear();
    for (const auto face : vertex_faces.at(v))
      for (const auto corner : faces[face])
        if (corner != v) others.push_back(corner);
    std::ranges::sort(others);
    for (std::size_t i = 0; i < others.size();) {
      std::size_t end = i + 1;
      while (end < others.size() && others[end] == others[i]) ++end;
      edges.emplace_back(v, others[i]);
      if (end - i == 1) border[v] = true;
      i = end;
    }
  }
  return {.graph = {boost::edges_are_sorted, edges.begin(), edges.end(), vertices,
                    static_cast<std::uint32_t>(edges.size())},
          .open_border = std::move(border)};
}

Vertex_graph vertex_graph(std::uint32_t vertex_count, std::span<const Corners> faces) {
  return surface_edges(Vertex_faces(vertex_count, faces), faces).graph;
}

std::vector<bool> open_border(std::uint32_t vertex_count, std::span<const Corners> faces) {
  return surface_edges(Vertex_faces(vertex_count, faces), faces).open_border;
}

}  // namespace lodestone
