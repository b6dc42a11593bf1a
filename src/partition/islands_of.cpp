// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/islands_of.h"

#include <algorithm>

namespace lodestone {

std::vector<std::vector<std::uint32_t>> islands_of(const Vertex_graph& graph, std::span<const std::uint32_t> vertices,
                                                   std::vector<bool>& open) {
  for (const auto v : vertices) open[v] = true;
  std::vector<std::vector<std::uint32_t>> result;
  for (const auto start : vertices) {
    if (!open[start]) continue;
    auto& island = result.emplace_back(1, start);
    open[start] = false;
    for (std::size_t i = 0; i < island.size(); ++i)
      for (const auto w : neighbours(graph, island[i]))
        if (open[w]) {
          open[w] = false;
          island.push_back(w);
        }
    std::ranges::sort(island);
  }
  return result;
}

}  // namespace lodestone
