// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <vector>

#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// CGAL's own property map of points that are three doubles each: they lie in its memory, one after the other. Another
/// type, also one derived from it, may give positions that are not in the memory that it shows.
template <class Points, class Mesh>
concept Contiguous_points =
    std::same_as<Points, typename Mesh::template Property_map<Vertex<Mesh>, typename Points::value_type>> &&
    requires(const Points& points) {
      { points.data()->cartesian_begin() } -> std::same_as<const double*>;
      requires sizeof(*points.data()) == 3 * sizeof(double);
    };

/// Reads the current coordinates of all vertices. This general version copies them.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
class Coordinate_reader {
 public:
  static constexpr bool in_memory = false;  ///< whether `read` refers to the memory of the mesh

  /// Reads through a point map, which is copied.
  explicit Coordinate_reader(Points points) : points_(std::move(points)) {}

  /// The current coordinates of all vertices.
  /// @return valid until the next call. O(V)
  Coordinates read(const Mesh_numbering<Mesh>& numbering) {
    coordinates_.resize(3 * std::size_t{numbering.vertex_count()});
    for (std::uint32_t i = 0; i < numbering.vertex_count(); ++i)
      Eigen::Map<Eigen::Vector3d>(coordinates_.data() + 3 * std::size_t{i}) =
          coordinates(get(points_, numbering.vertex(i)));
    return coordinates_;
  }

 private:
  Points points_;
  std::vector<double> coordinates_;
};

/// For CGAL::Surface_mesh with points of three doubles: refers to the memory of the mesh itself. O(1).
template <class P, Contiguous_points<CGAL::Surface_mesh<P>> Points>
class Coordinate_reader<CGAL::Surface_mesh<P>, Points> {
 public:
  static constexpr bool in_memory = true;  ///< `read` refers to the memory of the mesh
  /// The coordinates of a mesh with such points.
  /// @throws Bad_mesh  the points are those of a mesh with fewer vertices
  static Coordinates memory(const CGAL::Surface_mesh<P>& mesh, const Points& points) {
    return first_points(points, num_vertices(mesh));
  }

  /// Reads through a point map, which is copied.
  explicit Coordinate_reader(Points points) : points_(std::move(points)) {}

  /// The current coordinates of all vertices.
  /// @return the memory of the mesh, valid until its vertices change in number. O(1)
  /// @throws Bad_mesh  the points are those of a mesh with fewer vertices
  Coordinates read(const Mesh_numbering<CGAL::Surface_mesh<P>>& numbering) const {
    return first_points(points_, numbering.vertex_count());
  }

 private:
  static Coordinates first_points(const Points& points, std::size_t count) {
    if constexpr (requires { points.end() - points.begin(); })
      if (static_cast<std::size_t>(points.end() - points.begin()) < count)
        throw Bad_mesh("the point map has fewer points than the mesh has vertices");
    return {points.data()->cartesian_begin(), 3 * count};
  }

  Points points_;
};

}  // namespace lodestone
