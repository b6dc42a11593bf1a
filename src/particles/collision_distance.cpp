// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/collision_distance.h"

#include <cstdint>
#include <vector>

namespace lodestone {

namespace {

double mean_edge_length(const Vertex_graph& graph, const Positions& positions) {
  double sum = 0;
  std::size_t edges = 0;
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    for (const std::uint32_t w : neighbours(graph, v))
      if (v < w) {
        sum += (positions.row(v) - positions.row(w)).stableNorm();
        ++edges;
      }
  return edges == 0 ? 0 : sum / static_cast<double>(edges);
}

/// The positions of the vertices with edges.
Positions positions_of_surface(const Vertex_graph& graph, const Positions& positions) {
  std::vector<Eigen::Index> on_surface;
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    if (out_degree(v, graph) > 0) on_surface.push_back(v);
  return positions(on_surface, Eigen::all);
}

double mean_vertex_distance(const Positions& positions) {
  double sum = 0;
  for (Eigen::Index v = 1; v < positions.rows(); ++v)
    sum += (positions.topRows(v).rowwise() - positions.row(v)).rowwise().norm().sum();
  const auto count = static_cast<double>(positions.rows());
  return count < 2 ? 0 : sum / (count * (count - 1) / 2);
}

}  // namespace

double collision_distance(const Vertex_graph& graph, const Positions& positions, Distance_measure measure) {
  return measure == Distance_measure::adjacent_vertices ? mean_edge_length(graph, positions)
                                                        : mean_vertex_distance(positions_of_surface(graph, positions));
}

}  // namespace lodestone
