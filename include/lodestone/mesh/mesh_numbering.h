// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Dynamic_property_map.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

/// The three corners of a face as vertex indices.
using Corners = std::array<std::uint32_t, 3>;

/// One row per vertex: its position.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Maps a vertex index to the descriptor of the vertex. This general version stores a table.
template <Triangle_mesh Mesh>
class Vertex_table {
 public:
  explicit Vertex_table(const Mesh& mesh) : table_(vertices(mesh).begin(), vertices(mesh).end()) {}
  Vertex<Mesh> operator[](std::uint32_t index) const { return table_[index]; }

 private:
  std::vector<Vertex<Mesh>> table_;
};

/// CGAL::Surface_mesh needs no table: its descriptors are indices.
template <class P>
class Vertex_table<CGAL::Surface_mesh<P>> {
 public:
  using Mesh = CGAL::Surface_mesh<P>;

  explicit Vertex_table(const Mesh& mesh) {
    if (mesh.has_garbage()) throw Bad_mesh("the mesh holds removed elements: call collect_garbage() on it first");
  }
  Vertex<Mesh> operator[](std::uint32_t index) const { return Vertex<Mesh>(index); }
};

/// Vertices and faces of a mesh by index, in the order in which the mesh enumerates them.
///
/// Every later stage works on indices, so it is compiled once for all mesh types.
template <Triangle_mesh Mesh>
class Mesh_numbering {
 public:
  using Index_map = typename boost::property_map<Mesh, CGAL::dynamic_vertex_property_t<std::uint32_t>>::const_type;

  /// Cost O(V + F).
  /// @throws Bad_mesh  no face, a face that is not a triangle, more than 2^32 - 2 vertices or faces, or removed
  /// elements in a CGAL::Surface_mesh
  explicit Mesh_numbering(const Mesh& mesh);

  std::uint32_t vertex_count() const { return vertex_count_; }
  Vertex<Mesh> vertex(std::uint32_t index) const { return table_[index]; }
  std::uint32_t index(Vertex<Mesh> v) const { return get(index_, v); }
  /// Corners of every face, in the order of `faces(mesh)`.
  const std::vector<Corners>& corners() const { return corners_; }

 private:
  Vertex_table<Mesh> table_;
  std::uint32_t vertex_count_ = 0;
  Index_map index_;
  std::vector<Corners> corners_;
};

template <Triangle_mesh Mesh>
Mesh_numbering<Mesh>::Mesh_numbering(const Mesh& mesh)
    : table_(mesh), index_(get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh)) {
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max() - 1;
  if (num_faces(mesh) == 0) throw Bad_mesh("the mesh has no face");
  if (num_vertices(mesh) > limit || num_faces(mesh) > limit)
    throw Bad_mesh("the mesh has more than 4294967294 vertices or faces");

  for (const auto v : vertices(mesh)) put(index_, v, vertex_count_++);

  corners_.reserve(num_faces(mesh));
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    const auto second = next(h, mesh);
    const auto third = next(second, mesh);
    if (next(third, mesh) != h) throw Bad_mesh("face " + std::to_string(corners_.size()) + " is not a triangle");
    corners_.push_back({index(target(h, mesh)), index(target(second, mesh)), index(target(third, mesh))});
  }
}

/// Coordinates of a point of any kernel as doubles.
template <Point_like P>
Eigen::Vector3d coordinates(const P& p) {
  return {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())};
}

/// Positions of all vertices, by index. Cost O(V).
/// @throws Bad_mesh  a coordinate is not finite
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
Positions read_positions(const Mesh_numbering<Mesh>& numbering, const Points& points) {
  Positions positions(numbering.vertex_count(), 3);
  for (std::uint32_t i = 0; i < numbering.vertex_count(); ++i) {
    positions.row(i) = coordinates(get(points, numbering.vertex(i)));
    if (!positions.row(i).allFinite())
      throw Bad_mesh("vertex " + std::to_string(i) + " has a coordinate that is not finite");
  }
  return positions;
}

}  // namespace lodestone
