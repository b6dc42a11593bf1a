// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/region_steps.h"

#include <utility>

namespace lodestone {

Region_steps::Region_steps(const Vertex_graph& graph, std::span<const Region_index> labels) {
  offsets_.reserve(labels.size() + 1);
  vertices_.reserve(labels.size() + num_edges(graph));
  offsets_.push_back(0);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    bool listed = false;
    for (const std::uint32_t w : neighbours(graph, v)) {
      if (w > v && !std::exchange(listed, true)) vertices_.push_back(v);
      if (labels[v] == labels[w]) vertices_.push_back(w);
    }
    if (!listed) vertices_.push_back(v);
    offsets_.push_back(vertices_.size());
  }
}

}  // namespace lodestone
