// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Dynamic_property_map.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/triangle_corners.h"
#include "lodestone/mesh/unset_vector.h"
#include "lodestone/mesh/workers.h"

namespace lodestone {

/// The three corners of a face as vertex indices.
using Corners = std::array<std::uint32_t, 3>;

/// One row per vertex: its position.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Maps vertex indices to the descriptors of vertices, and back. This general version stores both.
template <Triangle_mesh Mesh>
class Vertex_table {
 public:
  static constexpr bool by_index = false;  ///< whether descriptors of vertices and faces are indices

  /// Lists the vertices in the order of `vertices(mesh)`. O(V).
  explicit Vertex_table(const Mesh& mesh)
      : table_(vertices(mesh).begin(), vertices(mesh).end()),
        index_(get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh)) {
    for (std::uint32_t i = 0; i < table_.size(); ++i) put(index_, table_[i], i);
  }
  /// Descriptor of the vertex with an index.
  Vertex<Mesh> operator[](std::uint32_t index) const { return table_[index]; }
  /// Index of a vertex.
  std::uint32_t index(Vertex<Mesh> v) const { return get(index_, v); }
  /// Number of vertices.
  std::size_t count(const Mesh& /*mesh*/) const { return table_.size(); }

 private:
  std::vector<Vertex<Mesh>> table_;
  typename boost::property_map<Mesh, CGAL::dynamic_vertex_property_t<std::uint32_t>>::const_type index_;
};

/// CGAL::Surface_mesh needs no table: its descriptors are indices.
template <class P>
class Vertex_table<CGAL::Surface_mesh<P>> {
 public:
  using Mesh = CGAL::Surface_mesh<P>;     ///< the mesh type
  static constexpr bool by_index = true;  ///< descriptors are indices

  /// @throws Bad_mesh  the mesh holds removed elements
  explicit Vertex_table(const Mesh& mesh) {
    if (mesh.has_garbage()) throw Bad_mesh("the mesh holds removed elements: call collect_garbage() on it first");
  }
  /// Descriptor of the vertex with an index.
  Vertex<Mesh> operator[](std::uint32_t index) const { return Vertex<Mesh>(index); }
  /// Index of a vertex.
  std::uint32_t index(Vertex<Mesh> v) const { return v; }
  /// Number of vertices of the mesh, as it is now.
  std::size_t count(const Mesh& mesh) const { return num_vertices(mesh); }
};

/// Refuses indices of faces that do not exist.
/// @throws Bad_argument  one of the indices is not below the number of faces
inline void check_faces(std::span<const std::uint32_t> indices, std::size_t face_count) {
  for (const auto face : indices)
    if (face >= face_count) throw Bad_argument("there is no face " + std::to_string(face));
}

/// Vertices and faces of a mesh by index, in the order in which the mesh enumerates them.
///
/// Every later stage works on indices, so it is compiled once for all mesh types.
template <Triangle_mesh Mesh>
class Mesh_numbering {
 public:
  /// Cost O(V + F).
  /// @param workers    share the faces, where descriptors are indices
  /// @throws Bad_mesh  no face, a face that is not a triangle, more than 2^32 - 2 vertices or faces, or removed
  ///                   elements that the mesh still counts
  explicit Mesh_numbering(const Mesh& mesh, Workers& workers = Workers::alone());

  /// Number of vertices, V.
  std::uint32_t vertex_count() const { return vertex_count_; }
  /// Descriptor of the vertex with an index.
  Vertex<Mesh> vertex(std::uint32_t index) const { return table_[index]; }
  /// Index of a vertex.
  std::uint32_t index(Vertex<Mesh> v) const { return table_.index(v); }
  /// Corners of every face, in the order of `faces(mesh)`.
  std::span<const Corners> corners() const& { return corners_; }
  /// The same of a temporary, copied.
  std::vector<Corners> corners() const&& { return {corners_.begin(), corners_.end()}; }

  /// Numbers the mesh anew after a change of its faces, reading it only where it has changed. CGAL::Surface_mesh only.
  /// @param changed        indices of faces that have other corners than before; new faces need not be listed
  /// @throws Bad_mesh      as the constructor; the numbering stays as it was
  /// @throws Bad_argument  an index is not below the number of faces; a face that is not listed has had a corner that
  ///                       there is no more; the numbering stays as it was
  void renumber(const Mesh& mesh, std::span<const std::uint32_t> changed);

 private:
  static void check_counts(const Mesh& mesh);
  void read_faces(const Mesh& mesh, Workers& workers);
  void check_kept_faces(std::span<const std::uint32_t> changed, std::size_t face_count,
                        std::uint32_t vertex_count) const;
  template <class Face>
  Corners corners_of(Face f, std::size_t index, const Mesh& mesh) const;

  Vertex_table<Mesh> table_;
  std::uint32_t vertex_count_ = 0;
  Unset_vector<Corners> corners_;
};

template <Triangle_mesh Mesh>
void Mesh_numbering<Mesh>::check_counts(const Mesh& mesh) {
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max() - 1;
  if (num_faces(mesh) == 0) throw Bad_mesh("the mesh has no face");
  if (num_vertices(mesh) > limit || num_faces(mesh) > limit)
    throw Bad_mesh("the mesh has more than 4294967294 vertices or faces");
}

template <Triangle_mesh Mesh>
template <class Face>
Corners Mesh_numbering<Mesh>::corners_of(Face f, std::size_t face, const Mesh& mesh) const {
  if constexpr (requires { mesh.check_corners(f); }) mesh.check_corners(f);
  const auto first = halfedge(f, mesh);
  if (!is_triangle(first, mesh)) throw Bad_mesh("face " + std::to_string(face) + " is not a triangle");
  const auto [p, q, r] = triangle_corners(first, mesh);
  return {index(p), index(q), index(r)};
}

template <Triangle_mesh Mesh>
Mesh_numbering<Mesh>::Mesh_numbering(const Mesh& mesh, Workers& workers) : table_(mesh) {
  check_counts(mesh);
  vertex_count_ = static_cast<std::uint32_t>(table_.count(mesh));
  read_faces(mesh, workers);
  // Some types of meshes count removed elements, and leave them out where they list the others.
  if (corners_.size() != num_faces(mesh) || vertex_count_ != num_vertices(mesh))
    throw Bad_mesh("the mesh holds removed elements: collect its garbage first");
}

template <Triangle_mesh Mesh>
void Mesh_numbering<Mesh>::read_faces(const Mesh& mesh, Workers& workers) {
  if constexpr (Vertex_table<Mesh>::by_index) {
    constexpr std::size_t at_once = 16384;  // a worker takes so many
    corners_.resize(num_faces(mesh));
    workers.run((corners_.size() + at_once - 1) / at_once, [&](std::size_t index, std::size_t) {
      const std::size_t end = std::min((index + 1) * at_once, corners_.size());
      for (std::size_t face = index * at_once; face < end; ++face)
        corners_[face] = corners_of(lodestone::Face<Mesh>(static_cast<std::uint32_t>(face)), face, mesh);
    });
  } else {
    corners_.reserve(num_faces(mesh));
    for (const auto f : faces(mesh)) corners_.push_back(corners_of(f, corners_.size(), mesh));
  }
}

template <Triangle_mesh Mesh>
void Mesh_numbering<Mesh>::renumber(const Mesh& mesh, std::span<const std::uint32_t> changed) {
  static_assert(Vertex_table<Mesh>::by_index, "where a vertex is removed, other meshes number many anew");
  const std::size_t face_count = num_faces(mesh);
  check_faces(changed, face_count);
  const Vertex_table<Mesh> table(mesh);  // refuses removed elements
  check_counts(mesh);
  const auto vertex_count = static_cast<std::uint32_t>(num_vertices(mesh));
  if (vertex_count < vertex_count_) check_kept_faces(changed, face_count, vertex_count);
  std::vector<Corners> other, added;
  const auto read = [&](std::uint32_t face) { return corners_of(lodestone::Face<Mesh>(face), face, mesh); };
  for (const auto face : changed) other.push_back(read(face));
  for (std::size_t face = corners_.size(); face < face_count; ++face)
    added.push_back(read(static_cast<std::uint32_t>(face)));
  corners_.reserve(face_count);
  // From here on nothing can fail.
  corners_.resize(std::min(corners_.size(), face_count));
  corners_.insert(corners_.end(), added.begin(), added.end());
  for (std::size_t i = 0; i < changed.size(); ++i) corners_[changed[i]] = other[i];
  vertex_count_ = vertex_count;
}

/// A list that leaves out faces can go unnoticed, but must not lead to vertices that do not exist.
template <Triangle_mesh Mesh>
void Mesh_numbering<Mesh>::check_kept_faces(std::span<const std::uint32_t> changed, std::size_t face_count,
                                            std::uint32_t vertex_count) const {
  std::vector<bool> listed(std::min(corners_.size(), face_count), false);
  for (const auto face : changed)
    if (face < listed.size()) listed[face] = true;
  for (std::size_t face = 0; face < listed.size(); ++face)
    if (!listed[face] && std::ranges::max(corners_[face]) >= vertex_count)
      throw Bad_argument("face " + std::to_string(face) +
                         " is not listed as changed, but one of its corners has been removed");
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
    if (!positions.row(i).allFinite()) fail_not_finite(i);
  }
  return positions;
}

}  // namespace lodestone
