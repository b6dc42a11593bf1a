// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/shared_vertices.h"

#include <algorithm>

namespace lodestone {

namespace {

constexpr Shared_vertices nothing_shared{no_shared_vertex, no_shared_vertex, no_shared_vertex};

/// Keeps the vertices for which `is_kept` holds, in front.
template <class Predicate>
Shared_vertices those_that(const Shared_vertices& vertices, const Predicate& is_kept) {
  Shared_vertices result = nothing_shared;
  std::size_t count = 0;
  for (const std::uint32_t vertex : vertices)
    if (vertex != no_shared_vertex && is_kept(vertex)) result[count++] = vertex;
  return result;
}

}  // namespace

Shared_vertices shared_vertices(const Tree_layout& layout, std::uint32_t leaf) {
  const auto faces = layout.corners(leaf);
  const auto vertices = layout.vertices(leaf);
  Shared_vertices result = nothing_shared;
  std::size_t count = 0;
  for (const auto corner : faces.front())
    if (std::ranges::all_of(faces, [&](const auto& face) { return std::ranges::count(face, corner) > 0; }))
      result[count++] = vertices[corner];
  return result;
}

std::vector<Shared_vertices> shared_vertices_of_nodes(const Tree_layout& layout) {
  std::vector<Shared_vertices> shared(layout.node_count());
  for (auto n = static_cast<std::uint32_t>(shared.size()); n-- > 0;) {
    const auto& node = layout.node(n);
    if (node.second_child == 0) {
      shared[n] = shared_vertices(layout, node.leaf);
    } else {
      const Shared_vertices& others = shared[node.second_child];
      shared[n] =
          those_that(shared[n + 1], [&](std::uint32_t vertex) { return std::ranges::count(others, vertex) > 0; });
    }
  }
  return shared;
}

bool have_one_in_common(const Shared_vertices& a, const Shared_vertices& b) {
  return std::ranges::any_of(
      a, [&](std::uint32_t vertex) { return vertex != no_shared_vertex && std::ranges::count(b, vertex) > 0; });
}

}  // namespace lodestone
