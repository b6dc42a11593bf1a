// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/random_voronoi.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/partition/geodesic_voronoi.h"
#include "partition/draw_without_repetition.h"
#include "partition/used_surface.h"

namespace lodestone {

std::vector<std::uint32_t> random_vertices(const Vertex_graph& graph, std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> order(num_vertices(graph));
  std::iota(order.begin(), order.end(), 0);
  const auto isolated =
      std::stable_partition(order.begin(), order.end(), [&](auto v) { return out_degree(v, graph) > 0; });

  std::mt19937_64 random(seed);
  const std::size_t drawn = draw_without_repetition({order.begin(), isolated}, count, random);
  order.resize(drawn + draw_without_repetition({isolated, order.end()}, count - drawn, random));
  return order;
}

Labelling Random_voronoi::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    const Positions positions = scaled_positions(used.positions);
    Geodesic_voronoi cells(used.graph, positions);
    cells.add(random_vertices(used.graph, wanted, options.seed));
    return {.labels = cells.labels()};
  });
}

}  // namespace lodestone
