// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/random_voronoi.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/partition/geodesic_voronoi.h"
#include "partition/used_surface.h"

namespace lodestone {

std::vector<std::uint32_t> random_vertices(const Vertex_graph& graph, std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> order(num_vertices(graph));
  std::iota(order.begin(), order.end(), 0);
  const auto isolated =
      std::stable_partition(order.begin(), order.end(), [&](auto v) { return out_degree(v, graph) > 0; });
  const auto with_edges = static_cast<std::size_t>(isolated - order.begin());

  // The first steps of a shuffle. It uses remainders, because they are the same on every platform, unlike the
  // distributions of the standard library.
  std::mt19937_64 random(seed);
  count = std::min(count, order.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t end = i < with_edges ? with_edges : order.size();
    std::swap(order[i], order[i + random() % (end - i)]);
  }
  order.resize(count);
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
