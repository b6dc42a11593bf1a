// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Reads positions by vertex index through a vertex point map.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
class Point_reader {
 public:
  Point_reader(Vertex_table<Mesh> table, Points points) : table_(std::move(table)), points_(std::move(points)) {}
  Eigen::Vector3d operator()(std::uint32_t vertex) const { return coordinates(get(points_, table_[vertex])); }

 private:
  Vertex_table<Mesh> table_;
  Points points_;
};

}  // namespace lodestone
