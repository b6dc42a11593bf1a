// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/vertex_graph.h"

#include <algorithm>
#include <utility>

namespace lodestone {

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Both directions of every side of every face, sorted. Keeps repeats; leaves out sides from a vertex to itself.
std::vector<Edge> sorted_sides(std::span<const Corners> faces) {
  std::vector<Edge> sides;
  sides.reserve(6 * faces.size());
  for (const auto& [a, b, c] : faces)
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}})
      if (from != to) sides.insert(sides.end(), {{from, to}, {to, from}});
  std::ranges::sort(sides);
  return sides;
}

}  // namespace

Vertex_graph vertex_graph(std::uint32_t vertex_count, std::span<const Corners> faces) {
  auto edges = sorted_sides(faces);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return {boost::edges_are_sorted, edges.begin(), edges.end(), vertex_count};
}

std::vector<bool> open_border(std::uint32_t vertex_count, std::span<const Corners> faces) {
  std::vector<bool> border(vertex_count, false);
  const auto sides = sorted_sides(faces);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end] == sides[i]) ++end;
    if (end - i == 1) border[sides[i].first] = border[sides[i].second] = true;
    i = end;
  }
  return border;
}

}  // namespace lodestone
