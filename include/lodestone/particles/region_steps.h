// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// Where a particle can be after one step: its vertex and the neighbours in its own region. Made once per partition, so
/// that a step reads only a short list.
class Region_steps {
 public:
  Region_steps() = default;
  /// Cost O(V + E).
  /// @param labels  V: region of each vertex
  Region_steps(const Vertex_graph& graph, std::span<const Region_index> labels);

  /// The vertices in reach of one step from `vertex`, itself among them, ascending.
  std::span<const std::uint32_t> from(std::uint32_t vertex) const {
    return std::span(vertices_).subspan(offsets_[vertex], offsets_[vertex + 1] - offsets_[vertex]);
  }

 private:
  std::vector<std::size_t> offsets_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace lodestone
