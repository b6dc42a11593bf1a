// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/partition/partition.h"

namespace lodestone {

/// A partition: labels and particles by vertex index.
struct Divided {
  std::vector<Region_index> labels;
  std::vector<std::uint32_t> particles;
  std::size_t regions = 0;

  bool operator==(const Divided&) const = default;
};

template <class Mesh, class Strategy>
Divided divide(const Mesh& mesh, std::size_t regions, const Strategy& strategy, const Partition_options& options = {}) {
  const auto map = get(CGAL::dynamic_vertex_property_t<Region_index>(), mesh);
  const auto result = partition(mesh, regions, map, strategy, options);
  const Mesh_numbering<Mesh> numbering(mesh);
  Divided divided{.labels = {}, .particles = {}, .regions = result.regions};
  for (const auto v : vertices(mesh)) divided.labels.push_back(get(map, v));
  for (const auto v : result.particles) divided.particles.push_back(numbering.index(v));
  return divided;
}

}  // namespace lodestone
