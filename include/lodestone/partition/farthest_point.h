// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Vertices far apart: the first drawn at random, each further one the farthest from all before it along the edges.
///
/// The largest distance from a vertex to the nearest of them is at most twice what any choice of so many vertices
/// reaches \cite gonzalez1985; as sampling of surfaces \cite eldar1997. A component without a seed is infinitely far;
/// of equally far vertices the lowest number is taken, vertices without edges after all others. Each seed visits the
/// vertices that become nearer, O(V log V) for all seeds on a surface whose cells shrink evenly, and looks at all for
/// the farthest: O(N V).
///
/// @param positions  V x 3, of a size at which squares and the length of the longest path do not overflow
/// @param count      at most V; more are cut down to V
std::vector<std::uint32_t> farthest_points(const Vertex_graph& graph, const Positions& positions, std::size_t count,
                                           std::uint64_t seed);

struct Farthest_point_options {
  std::uint64_t seed = 1;  ///< of the draw of the first vertex
};

/// Partition strategy: the vertices nearest along the edges to each of N `farthest_points`. See `Geodesic_voronoi`.
struct Farthest_point {
  static constexpr std::string_view name = "farthest_point";

  Farthest_point_options options = {};

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
