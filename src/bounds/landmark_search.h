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

  /// The landmarks of a node, with radii that are not yet made longer for rounding. If the root has a vertex that none
  /// of its landmarks reaches, a radius is infinite.
  /// @return none: of another node some vertices cannot be reached, or not without coming to too many others
  std::span<const Landmark> find(std::uint32_t node);

 private:
  /// A connected part of the node: vertices that faces of the node connect.
  struct Part {
    std::uint32_t size = 0;
    Eigen::AlignedBox3d box;
    Landmark centre;                                                    ///< the vertex nearest to the centre of the box
    double squared_distance = std::numeric_limits<double>::infinity();  ///< between the two
  };
  /// A vertex that a path has reached.
  struct Reached {
    double distance;
    std::uint32_t vertex, landmark;
    bool operator>(const Reached& other) const { return distance > other.distance; }
  };

  void list_vertices(std::uint32_t node);
  void join_faces(std::uint32_t node);
  void measure_parts();
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
  std::vector<std::uint32_t> part_of_;     ///< V: the part of the root of a tree
  std::vector<Part> parts_;
  std::vector<Landmark> landmarks_;
  std::uint32_t node_ = 0;

  // Of the search for shortest paths.
  std::vector<Reached> heap_;
  std::vector<double> distance_;            ///< V: the shortest so far
  std::vector<std::uint32_t> reached_for_;  ///< V: the node, plus 1, that `distance_` is of
};

}  // namespace lodestone
