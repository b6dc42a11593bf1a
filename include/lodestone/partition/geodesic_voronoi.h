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
/// Distance is the length of the shortest path of edges. Of equally near seeds the one added first wins. But a seed
/// always belongs to itself, even if another seed has the same position, so no cell is empty. The cells of seeds that
/// were added in one call are connected.
///
/// Seeds may be added one by one. Each call visits only the vertices that become nearer: Dijkstra's algorithm on the
/// graph of the edges that shorten a path. That is O(U log U) for U such vertices and their edges, and O(V) for the
/// marks of the search.
class Geodesic_voronoi {
 public:
  /// Stands for the seed of a vertex that none reaches.
  static constexpr Region_index no_seed = std::numeric_limits<Region_index>::max();

  /// Both arguments must outlive the object. Cost O(V + E).
  /// @param positions  V x 3; their squares do not overflow, nor does the length of the longest path
  Geodesic_voronoi(const Vertex_graph& graph, const Positions& positions);

  /// Makes vertices seeds. Their indices continue those of the earlier seeds.
  /// @throws Bad_argument  there is no such vertex, or it is a seed already
  void add(std::span<const std::uint32_t> vertices);

  /// Forgets all seeds. Cost O(V).
  void clear();

  /// Vertices of the seeds, in the order in which they were added.
  const std::vector<std::uint32_t>& seeds() const { return seeds_; }
  /// Whether a vertex is a seed.
  bool is_seed(std::uint32_t vertex) const { return is_seed_[vertex]; }

  /// Distance from the nearest seed along the edges, in units of the positions; infinity if no seed reaches the vertex.
  double distance(std::uint32_t vertex) const { return nearest_[vertex].distance; }

  /// Index of the nearest seed along the edges; `no_seed` if none reaches the vertex.
  Region_index nearest_seed(std::uint32_t vertex) const { return nearest_[vertex].seed; }

  /// The same for all vertices. A vertex that no seed reaches along the edges gets the seed that is nearest in a
  /// straight line. O(V + U N) for U such vertices and N seeds.
  std::vector<Region_index> labels() const;

 private:
  /// A seed and its distance, in lexicographic order of distance and seed.
  struct Seed_distance {
    double distance = std::numeric_limits<double>::infinity();
    Region_index seed = no_seed;

    Seed_distance after(double length) const { return {distance + length, seed}; }
    bool operator<(const Seed_distance& other) const {
      return distance < other.distance || (distance == other.distance && seed < other.seed);
    }
  };
  using Edge = Vertex_graph::edge_descriptor;

  /// Selects the edges over which the path to their far end becomes shorter.
  struct Shortens {
    const Geodesic_voronoi* cells = nullptr;
    bool operator()(const Edge& edge) const { return cells->shortens(edge); }
  };

  double length(const Edge& edge) const { return lengths_[get(boost::edge_index, graph_, edge)]; }
  bool shortens(const Edge& edge) const;
  Region_index nearest_in_a_straight_line(std::uint32_t vertex) const;

  const Vertex_graph& graph_;
  const Positions& positions_;
  std::vector<double> lengths_;         ///< per edge
  std::vector<Seed_distance> nearest_;  ///< V
  std::vector<std::uint32_t> seeds_;
  std::vector<bool> is_seed_;  ///< V
};

}  // namespace lodestone
