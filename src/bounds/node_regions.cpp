// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/node_regions.h"

#include <cstdint>

namespace lodestone {

std::vector<Region_index> node_regions(const Tree_layout& layout, std::span<const Region_index> labels) {
  std::vector<Region_index> regions(layout.node_count(), 0);
  if (labels.empty()) return regions;
  const auto common = [](Region_index a, Region_index b) { return a == b ? a : several_regions; };
  for (auto node = static_cast<std::uint32_t>(layout.node_count()); node-- > 0;) {
    if (!layout.is_leaf(node)) {
      regions[node] = common(regions[node + 1], regions[layout.node(node).second_child]);
      continue;
    }
    const auto vertices = layout.vertices(layout.node(node).leaf);
    regions[node] = labels[vertices.front()];
    for (const auto vertex : vertices) regions[node] = common(regions[node], labels[vertex]);
  }
  return regions;
}

}  // namespace lodestone
