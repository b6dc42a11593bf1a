// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Iterator_range.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/iterator/counting_iterator.hpp>
#include <boost/property_map/property_map.hpp>
#include <boost/property_map/vector_property_map.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/region_maps.h"

namespace lodestone {

/// Triangles as two arrays that the caller keeps: the coordinates of the vertices, and the corners of the faces. A model
/// of Triangle_mesh, for programs that have arrays and no half-edge mesh.
///
///     std::vector<double> coordinates = ...;  // x, y, z of each vertex
///     std::vector<Corners> faces = ...;
///     Indexed_mesh mesh(coordinates, faces);
///     detector.add(mesh);
///
/// Both arrays are read where they lie. Coordinates that the caller writes count in the next query; a detector takes
/// faces that the caller writes at its next `rebuild`. Vertices and faces are numbered as in the arrays. Everything that
/// a file can hold is legal: an edge with three faces, neighbours of opposite orientations, a face that names a vertex
/// twice, a vertex without a face.
class Indexed_mesh {
  /// What `Array&&` is deduced as from a temporary vector.
  template <class Array, class Element>
  static constexpr bool ends_with_the_call = std::same_as<std::remove_const_t<Array>, std::vector<Element>>;

 public:
  /// Indices of vertices or faces, from 0.
  using Index_range = CGAL::Iterator_range<boost::counting_iterator<std::uint32_t>>;

  /// O(F).
  /// @param coordinates  3 V; must outlive the mesh
  /// @param faces        F; must outlive the mesh
  /// @throws Bad_mesh    the coordinates do not come in threes; a face names a vertex that does not exist
  Indexed_mesh(Coordinates coordinates, std::span<const Corners> faces);
  /// The mesh refers to arrays, not to temporaries.
  Indexed_mesh(const std::vector<double>&& coordinates, std::span<const Corners> faces) = delete;
  template <class Numbers, class Faces>
    requires(ends_with_the_call<Numbers, double> || ends_with_the_call<Faces, Corners>)
  Indexed_mesh(Numbers&& coordinates, Faces&& faces) = delete;

  /// Reads the vertices elsewhere from now on. O(1).
  /// @param coordinates  3 V, of as many vertices as before; must outlive the mesh
  /// @throws Bad_mesh    another number
  void set_coordinates(Coordinates coordinates);
  template <class Numbers>
    requires ends_with_the_call<Numbers, double>
  void set_coordinates(Numbers&& coordinates) = delete;
  /// Takes other arrays in place of both. A detector that has the mesh needs a `rebuild`. O(F).
  /// @throws Bad_mesh    as the constructor; the mesh stays as it was
  void set_arrays(Coordinates coordinates, std::span<const Corners> faces) { *this = Indexed_mesh(coordinates, faces); }
  void set_arrays(const std::vector<double>&& coordinates, std::span<const Corners> faces) = delete;
  template <class Numbers, class Faces>
    requires(ends_with_the_call<Numbers, double> || ends_with_the_call<Faces, Corners>)
  void set_arrays(Numbers&& coordinates, Faces&& faces) = delete;

  /// 3 V, where they are read.
  Coordinates coordinates() const { return coordinates_; }
  /// Of the first so many vertices.
  /// @throws Bad_mesh  there are fewer
  Coordinates first_points(std::size_t count) const;
  /// The corners of each face.
  std::span<const Corners> corners() const { return faces_; }

  /// Where a vertex is now.
  Point point(std::uint32_t vertex) const {
    const double* position = coordinates_.data() + 3 * std::size_t{vertex};
    return {position[0], position[1], position[2]};
  }

  /// Whether the corners of a face are vertices. They can be others since the constructor looked: the array is the
  /// caller's.
  bool has_corners(std::uint32_t face) const { return std::ranges::max(faces_[face]) < coordinates_.size() / 3; }
  /// @throws Bad_mesh  a corner of the face is no vertex
  void check_corners(std::uint32_t face) const;

  // What Triangle_mesh asks for.

  /// All vertices.
  friend Index_range vertices(const Indexed_mesh& mesh) { return range(num_vertices(mesh)); }
  /// All faces.
  friend Index_range faces(const Indexed_mesh& mesh) { return range(num_faces(mesh)); }
  /// V.
  friend std::size_t num_vertices(const Indexed_mesh& mesh) { return mesh.coordinates_.size() / 3; }
  /// F.
  friend std::size_t num_faces(const Indexed_mesh& mesh) { return mesh.faces_.size(); }
  /// 3 F: no two faces share a halfedge.
  friend std::size_t num_halfedges(const Indexed_mesh& mesh) { return 3 * num_faces(mesh); }
  /// The halfedge of a face that ends at its first corner: 3 f + i ends at corner i of face f.
  friend std::size_t halfedge(std::uint32_t face, const Indexed_mesh&) { return 3 * std::size_t{face}; }
  /// The next halfedge around the same face.
  friend std::size_t next(std::size_t halfedge, const Indexed_mesh&) {
    return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1;
  }
  /// The vertex at which a halfedge ends.
  friend std::uint32_t target(std::size_t halfedge, const Indexed_mesh& mesh) {
    return mesh.faces_[halfedge / 3][halfedge % 3];
  }

 private:
  static Index_range range(std::size_t count) {
    using Index = boost::counting_iterator<std::uint32_t>;
    return CGAL::make_range(Index(0), Index(static_cast<std::uint32_t>(count)));
  }

  Coordinates coordinates_;
  std::span<const Corners> faces_;
};

/// The vertex point map of an Indexed_mesh.
class Indexed_points {
 public:
  using key_type = std::uint32_t;                      ///< index of a vertex
  using value_type = Point;                            ///< its position
  using reference = Point;                             ///< by value
  using category = boost::readable_property_map_tag;  ///< it cannot be written through

  /// @param mesh  must outlive the map
  explicit Indexed_points(const Indexed_mesh& mesh) : mesh_(&mesh) {}
  /// The mesh whose points these are.
  const Indexed_mesh& mesh() const { return *mesh_; }
  /// Where a vertex is now.
  friend Point get(const Indexed_points& points, std::uint32_t vertex) { return points.mesh_->point(vertex); }

 private:
  const Indexed_mesh* mesh_;
};

/// The vertex point map of a mesh.
inline Indexed_points get(CGAL::vertex_point_t, const Indexed_mesh& mesh) { return Indexed_points(mesh); }
/// The vertex index map of a mesh: vertices are indices.
inline boost::typed_identity_property_map<std::uint32_t> get(boost::vertex_index_t, const Indexed_mesh&) { return {}; }

}  // namespace lodestone

/// @cond  what Boost's and CGAL's graphs ask for
template <>
struct boost::graph_traits<lodestone::Indexed_mesh> {
  using vertex_descriptor = std::uint32_t;
  using halfedge_descriptor = std::size_t;
  using face_descriptor = std::uint32_t;
  using vertices_size_type = std::uint32_t;
  using halfedges_size_type = std::size_t;
  using faces_size_type = std::uint32_t;
};
template <>
struct boost::property_map<lodestone::Indexed_mesh, CGAL::vertex_point_t> {
  using type = lodestone::Indexed_points;
  using const_type = lodestone::Indexed_points;
};
template <>
struct boost::property_map<lodestone::Indexed_mesh, boost::vertex_index_t> {
  using type = boost::typed_identity_property_map<std::uint32_t>;
  using const_type = type;
};
template <>
struct CGAL::graph_has_property<lodestone::Indexed_mesh, CGAL::vertex_point_t> : CGAL::Tag_true {};
template <>
struct CGAL::graph_has_property<lodestone::Indexed_mesh, boost::vertex_index_t> : CGAL::Tag_true {};
/// @endcond

namespace lodestone {

/// Descriptors are indices.
template <>
class Vertex_table<Indexed_mesh> {
 public:
  static constexpr bool by_index = true;  ///< descriptors are indices

  /// Keeps nothing.
  explicit Vertex_table(const Indexed_mesh&) {}
  /// The vertex with an index.
  std::uint32_t operator[](std::uint32_t index) const { return index; }
  /// Index of a vertex.
  std::uint32_t index(std::uint32_t vertex) const { return vertex; }
  /// Number of vertices.
  std::size_t count(const Indexed_mesh& mesh) const { return num_vertices(mesh); }
};

/// Refers to the caller's array. O(1).
template <>
class Coordinate_reader<Indexed_mesh, Indexed_points> {
 public:
  static constexpr bool in_memory = true;  ///< `read` refers to the caller's array
  /// The coordinates of a mesh.
  static Coordinates memory(const Indexed_mesh& mesh, const Indexed_points&) { return mesh.coordinates(); }

  /// Reads through a point map, which is copied.
  explicit Coordinate_reader(Indexed_points points) : points_(points) {}
  /// The current coordinates of all vertices, in the caller's array.
  /// @throws Bad_mesh  the points are those of a mesh with fewer vertices
  Coordinates read(const Mesh_numbering<Indexed_mesh>& numbering) const {
    return points_.mesh().first_points(numbering.vertex_count());
  }

 private:
  Indexed_points points_;
};

/// The mesh has no properties of its own, so the maps are beside it.
template <>
struct Region_property<Indexed_mesh> {
  /// Property map from vertices to regions; copies share their values.
  using Map = boost::vector_property_map<Region_index>;
  /// Makes a map, `no_particle` everywhere; it has no name.
  static Map add(const Indexed_mesh& mesh, const char* /*name*/) {
    Map map(static_cast<unsigned>(num_vertices(mesh)));
    for (std::uint32_t v = 0; v < num_vertices(mesh); ++v) map[v] = no_particle;
    return map;
  }
};

}  // namespace lodestone
