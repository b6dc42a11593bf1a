// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// A vertex point map that counts how often it is read.
struct Counting_points {
  const Surface_mesh* mesh = nullptr;
  std::size_t* reads = nullptr;
  friend Point get(const Counting_points& map, Surface_mesh::Vertex_index v) {
    ++*map.reads;
    return map.mesh->point(v);
  }
};

}  // namespace lodestone
