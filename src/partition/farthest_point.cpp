// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/farthest_point.h"

#include <algorithm>
#include <utility>

#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/partition/geodesic_voronoi.h"
#include "lodestone/partition/random_voronoi.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

/// Among the vertices that are not seeds; there must be one.
std::uint32_t farthest_vertex(const Vertex_graph& graph, const Geodesic_voronoi& cells) {
  std::uint32_t farthest = 0;
  std::pair<bool, double> best{false, -1};
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v) {
    const std::pair<bool, double> rank{out_degree(v, graph) > 0, cells.distance(v)};
    if (!(best < rank) || cells.is_seed(v)) continue;
    best = rank;
    farthest = v;
  }
  return farthest;
}

}  // namespace

std::vector<std::uint32_t> farthest_points(const Vertex_graph& graph, const Positions& positions, std::size_t count,
                                           std::uint64_t seed) {
  Geodesic_voronoi cells(graph, positions);
  cells.add(random_vertices(graph, std::min<std::size_t>(count, 1), seed));
  count = std::min<std::size_t>(count, num_vertices(graph));
  while (cells.seeds().size() < count) {
    const std::uint32_t farthest = farthest_vertex(graph, cells);
    cells.add({&farthest, 1});
  }
  return cells.seeds();
}

Labelling Farthest_point::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    const Positions positions = scaled_positions(used.positions);
    Geodesic_voronoi cells(used.graph, positions);
    // All at once, because cells that grow one after the other need not be connected if distances are equal.
    cells.add(farthest_points(used.graph, positions, wanted, options.seed));
    return {.labels = cells.labels()};
  });
}

}  // namespace lodestone
