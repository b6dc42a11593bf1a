// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// Voronoi cells of seed vertices on a surface: every vertex belongs to the seed that is nearest along the edges.
///
/// Distance is the length of the shortest path of edges. Of equally near seeds the first added wins, except that a seed
/// always belongs to itself, also where another lies at the same place: no cell is empty. The cells of seeds that were
/// added in one call are connected.
///
/// Seeds may be added one by one: each call visits only the vertices that become nearer (Dijkstra's algorithm on the
/// graph of the edges that shorten a path), which is O(U log U) for U such vertices and their edges, and O(V) for the
/// marks of the search.
class Geodesic_voronoi {
 public:
  static constexpr Region_index no_seed = std::numeric_limits<Region_index>::max();

  /// Both arguments must outlive the object. Cost O(V + E).
  /// @param positions  V x 3, of a size at which squares and the length of the longest path do not overflow
  Geodesic_voronoi(const Vertex_graph& graph, const Positions& positions);

  /// Makes seeds of vertices, numbered on from the seeds there are.
  /// @throws Bad_argument  there is no such vertex, or it is a seed already
  void add(std::span<const std::uint32_t> vertices);

  /// Forgets all seeds. Cost O(V).
  void clear();

  const std::vector<std::uint32_t>& seeds() const { return seeds_; }
  bool is_seed(std::uint32_t vertex) const { return is_seed_[vertex]; }

  /// Distance from the nearest seed along the edges, in units of the positions; infinity where no seed reaches.
  double distance(std::uint32_t vertex) const { return reaches_[vertex].distance; }

  /// Number of the nearest seed along the edges; `no_seed` where none reaches.
  Region_index nearest_seed(std::uint32_t vertex) const { return reaches_[vertex].seed; }

  /// The same for all vertices; where no seed reaches along the edges, the nearest in a straight line. O(V + U N) for U
  /// vertices that none of N seeds reaches.
  std::vector<Region_index> labels() const;

 private:
  /// How near which seed is: ordered by distance, equal distances by seed.
  struct Reach {
    double distance = std::numeric_limits<double>::infinity();
    Region_index seed = no_seed;

    Reach after(double length) const { return {distance + length, seed}; }
    bool operator<(const Reach& other) const {
      return distance < other.distance || (distance == other.distance && seed < other.seed);
    }
  };
  using Edge = Vertex_graph::edge_descriptor;

  /// True of the edges over which a path to their far end becomes shorter.
  struct Shortens {
    const Geodesic_voronoi* cells = nullptr;
    bool operator()(const Edge& edge) const { return cells->shortens(edge); }
  };

  double length(const Edge& edge) const { return lengths_[get(boost::edge_index, graph_, edge)]; }
  bool shortens(const Edge& edge) const;
  Region_index nearest_in_a_straight_line(std::uint32_t vertex) const;

  const Vertex_graph& graph_;
  const Positions& positions_;
  std::vector<double> lengths_;  ///< per edge
  std::vector<Reach> reaches_;   ///< V
  std::vector<std::uint32_t> seeds_;
  std::vector<bool> is_seed_;  ///< V
};

}  // namespace lodestone
