// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <vector>

#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// A property map whose points lie one after the other in memory, each three doubles.
template <class Points>
concept Contiguous_points = requires(const Points& points) {
  { points.data()->cartesian_begin() } -> std::same_as<const double*>;
  requires sizeof(*points.data()) == 3 * sizeof(double);
};

/// Hands out the coordinates of all vertices as they are now. A copy in general.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
class Coordinate_reader {
 public:
  explicit Coordinate_reader(Points points) : points_(std::move(points)) {}

  /// Valid until the next call. O(V).
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

/// The memory of the mesh itself for CGAL::Surface_mesh with points of three doubles: O(1).
template <class P, Contiguous_points Points>
class Coordinate_reader<CGAL::Surface_mesh<P>, Points> {
 public:
  explicit Coordinate_reader(Points points) : points_(std::move(points)) {}

  Coordinates read(const Mesh_numbering<CGAL::Surface_mesh<P>>& numbering) const {
    return {points_.data()->cartesian_begin(), 3 * std::size_t{numbering.vertex_count()}};
  }

 private:
  Points points_;
};

}  // namespace lodestone
