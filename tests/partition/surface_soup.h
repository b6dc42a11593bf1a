// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/partition.h"
#include "support/test_meshes.h"

namespace lodestone {

/// A surface as a list of faces, which need not form a mesh.
struct Surface_soup {
  Positions positions;
  std::vector<Corners> faces;
  Vertex_graph graph = vertex_graph(static_cast<std::uint32_t>(positions.rows()), faces);

  Numbered_surface surface() const { return {graph, positions, faces}; }
};

inline Surface_soup surface_soup(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  return {numbered.positions, {numbered.faces.begin(), numbered.faces.end()}};
}

}  // namespace lodestone
