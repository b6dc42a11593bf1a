// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/geodesic_oracle.h"

namespace lodestone {

std::vector<double> plain_distances(const Vertex_graph& graph, const Positions& positions, std::uint32_t source) {
  std::vector<double> distances(num_vertices(graph), std::numeric_limits<double>::infinity());
  distances[source] = 0;
  for (bool changing = true; changing;) {
    changing = false;
    for (std::uint32_t v = 0; v < distances.size(); ++v)
      for (const std::uint32_t w : neighbours(graph, v)) {
        const double over_v = distances[v] + (positions.row(v) - positions.row(w)).norm();
        if (!(over_v < distances[w])) continue;
        distances[w] = over_v;
        changing = true;
      }
  }
  return distances;
}

std::vector<double> plain_distances_to_nearest(const Vertex_graph& graph, const Positions& positions,
                                               const std::vector<std::uint32_t>& sources) {
  std::vector<double> nearest(num_vertices(graph), std::numeric_limits<double>::infinity());
  for (const auto source : sources) {
    const auto distances = plain_distances(graph, positions, source);
    for (std::size_t v = 0; v < nearest.size(); ++v) nearest[v] = std::min(nearest[v], distances[v]);
  }
  return nearest;
}

}  // namespace lodestone
