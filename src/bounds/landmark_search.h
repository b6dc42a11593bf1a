// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/mesh/vertex_graph.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Finds the landmarks of nodes, one node after the other. See Stretch_bound.
class Landmark_search {
 public:
  static constexpr std::size_t most_landmarks = 3;

  /// @param rest  3 V; must outlive this, as must the layout
  Landmark_search(const Tree_layout& layout, Coordinates rest);

  /// The landmarks of a node, with radii that are not yet made longer for rounding.
  /// @return none: the paths are too long, or there are none; for the root, which has no parent to turn to, the radius
  ///         of a vertex that cannot be reached is infinite
  std::span<const Landmark> find(std::uint32_t node);

 private:
  /// Vertices of the node that faces of the node connect.
  struct Piece {
    std::uint32_t size = 0;
    Eigen::AlignedBox3d box;
    Landmark centre;
    double from_centre =
        std::numeric_limits<double>::infinity();  ///< squared distance of the landmark from the centre of the box
  };
  /// A vertex that a path has reached.
  struct Reached {
    double distance;
    std::uint32_t vertex, landmark;
    bool operator>(const Reached& other) const { return distance > other.distance; }
  };

  void list_vertices(std::uint32_t node);
  void join_faces(std::uint32_t node);
  void measure_pieces();
  void choose_centres();
  bool measure_radii(std::size_t budget);
  void relax_edges_of(const Reached& from);

  std::uint32_t root_of(std::uint32_t vertex);
  Eigen::Vector3d rest(std::uint32_t vertex) const {
    return Eigen::Map<const Eigen::Vector3d>(rest_.data() + 3 * std::size_t{vertex});
  }

  const Tree_layout& layout_;
  Coordinates rest_;
  Vertex_graph graph_;
  std::vector<double> lengths_;  ///< per edge of the graph

  // Of the node under way.
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> listed_for_;  ///< V: the node, plus 1, for which a vertex was last listed
  std::vector<std::uint32_t> joined_;      ///< V: a union-find forest
  std::vector<std::uint32_t> piece_of_;    ///< V: the piece of the root of a tree
  std::vector<Piece> pieces_;
  std::vector<Landmark> landmarks_;
  std::uint32_t node_ = 0;

  // Of the search for shortest paths.
  std::vector<Reached> heap_;
  std::vector<double> distance_;            ///< V: the shortest so far
  std::vector<std::uint32_t> reached_for_;  ///< V: the node, plus 1, that `distance_` is of
};

}  // namespace lodestone
