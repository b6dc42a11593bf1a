// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Vertices far apart. The first is drawn at random; each further one is the vertex farthest along the edges from all
/// chosen before.
///
/// The largest distance from a vertex to the nearest chosen one is at most twice the least that any choice of so many
/// vertices reaches \cite gonzalez1985. Farthest points as a sampling of surfaces: \cite eldar1997. A component without
/// a seed is infinitely far. Ties go to the lowest vertex index; vertices without edges come after all others. Each
/// seed visits the vertices that become nearer, which is O(V log V) for all seeds if the cells of the surface shrink
/// evenly. Each seed also scans all vertices for the farthest: O(N V).
///
/// @param positions  V x 3; their squares do not overflow, nor does the length of the longest path
/// @param count      number of vertices; above V it is reduced to V
std::vector<std::uint32_t> farthest_points(const Vertex_graph& graph, const Positions& positions, std::size_t count,
                                           std::uint64_t seed);

/// Options of Farthest_point.
struct Farthest_point_options {
  std::uint64_t seed = 1;  ///< of the draw of the first vertex
};

/// Partition strategy: the vertices nearest along the edges to each of N `farthest_points`. See `Geodesic_voronoi`.
struct Farthest_point {
  static constexpr std::string_view name = "farthest_point";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;                 ///< see Partition_strategy

  Farthest_point_options options = {};  ///< the seed

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
