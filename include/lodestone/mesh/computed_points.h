// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/boost/graph/named_params_helper.h>

#include <Eigen/Core>
#include <boost/property_map/property_map.hpp>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/unset_vector.h"

/// Positions that nobody has written to memory: each is computed when it is read.
namespace lodestone {

/// The positions of V vertices in the current pose, by vertex index. A vertex comes out with the same bits whichever
/// function computes it, and whatever else it computes.
///
/// `points(v)` computes one. `points.pose(vertices, coordinates)` computes those of a list, in which no vertex stands
/// twice, and writes each to its three places among 3 V coordinates. `points.pose_all(coordinates)` writes all.
/// `points.pose_number()` is above 0 and grows whenever the pose changes.
///
/// `points.shape_number()`, which points need not have, grows whenever anything else changes on which bounds of a
/// region rest, such as positions at rest or the weights of joints; so does the pose number then. A detector makes
/// bounds anew. Promises that it was given stay as they are: about where the vertices were first.
///
/// Several threads may compute positions at once while none changes the pose. Models: Skinned_points, Morphed_points,
/// Deformed_points, Computed_motion.
template <class P>
concept Computed_points = requires(const P& points, std::uint32_t vertex, std::span<const std::uint32_t> vertices,
                                   std::span<double> coordinates) {
  { points.vertex_count() } -> std::convertible_to<std::uint32_t>;
  { points(vertex) } -> std::convertible_to<Eigen::Vector3d>;
  points.pose(vertices, coordinates);
  points.pose_all(coordinates);
  { points.pose_number() } -> std::convertible_to<std::uint64_t>;
};

/// Computed points as a vertex point map of a mesh. Cheap to copy. Make it with `point_map`.
template <Triangle_mesh Mesh, Computed_points Points>
class Computed_point_map {
 public:
  using key_type = Vertex<Mesh>;                      ///< a vertex of the mesh
  using value_type = Point;                           ///< its position
  using reference = Point;                            ///< positions are computed, so there is nothing to refer to
  using category = boost::readable_property_map_tag;  ///< of property maps: to be read only
  /// Maps vertices to indices from 0: the mesh's own map, or one that was made for it.
  using Index_map = decltype(CGAL::get_initialized_vertex_index_map(std::declval<const Mesh&>()));

  /// See `point_map`.
  Computed_point_map(const Mesh& mesh, const Points& points)
      : points_(&points), index_(CGAL::get_initialized_vertex_index_map(mesh)) {}

  /// Computes the position of a vertex.
  friend Point get(const Computed_point_map& map, key_type vertex) {
    const Eigen::Vector3d position = (*map.points_)(map.index(vertex));
    return {position.x(), position.y(), position.z()};
  }

  /// What computes the positions.
  const Points& points() const { return *points_; }
  /// Whether the points are numbered as the vertices of the mesh are. O(1) for Surface_mesh, else O(V).
  bool in_order(const Mesh_numbering<Mesh>& numbering) const {
    if (points_->vertex_count() < numbering.vertex_count()) return false;
    if constexpr (!Vertex_table<Mesh>::by_index)
      for (std::uint32_t i = 0; i < numbering.vertex_count(); ++i)
        if (index(numbering.vertex(i)) != i) return false;
    return true;
  }
  /// Index of a vertex among the points.
  std::uint32_t index(key_type vertex) const { return static_cast<std::uint32_t>(get(index_, vertex)); }

 private:
  const Points* points_;
  Index_map index_;
};

/// The vertex point map of a mesh that is where `points` say. Vertex indices are those of the mesh where it has some
/// that count from 0, else the order of `vertices(mesh)`.
/// @param points  one per vertex; must outlive the map. Change the pose between two frames
template <Triangle_mesh Mesh, Computed_points Points>
Computed_point_map<Mesh, Points> point_map(const Mesh& mesh, const Points& points) {
  return {mesh, points};
}
template <Triangle_mesh Mesh, Computed_points Points>
Computed_point_map<Mesh, Points> point_map(const Mesh& mesh, const Points&& points) = delete;

/// Computes all positions at once.
template <Triangle_mesh Mesh, Computed_points Points>
class Coordinate_reader<Mesh, Computed_point_map<Mesh, Points>> {
 public:
  static constexpr bool in_memory = false;  ///< positions are written to memory of the reader

  /// Reads through a map, which is copied.
  explicit Coordinate_reader(Computed_point_map<Mesh, Points> map) : map_(std::move(map)) {}

  /// The current coordinates of all vertices.
  /// @return valid until the next call. O(V)
  /// @throws Bad_argument  there are fewer points than vertices
  Coordinates read(const Mesh_numbering<Mesh>& numbering) {
    if (map_.points().vertex_count() < numbering.vertex_count())
      throw Bad_argument("there are fewer computed points than the mesh has vertices");
    const std::size_t size = 3 * std::size_t{numbering.vertex_count()};
    posed_.resize(3 * std::size_t{map_.points().vertex_count()});
    map_.points().pose_all(posed_);
    if constexpr (Vertex_table<Mesh>::by_index) return Coordinates(posed_).first(size);
    ordered_.resize(size);
    for (std::uint32_t i = 0; i < numbering.vertex_count(); ++i)
      Eigen::Map<Eigen::Vector3d>(ordered_.data() + 3 * std::size_t{i}) =
          Eigen::Map<const Eigen::Vector3d>(posed_.data() + 3 * std::size_t{map_.index(numbering.vertex(i))});
    return ordered_;
  }

 private:
  Computed_point_map<Mesh, Points> map_;
  Unset_vector<double> posed_, ordered_;
};

}  // namespace lodestone
