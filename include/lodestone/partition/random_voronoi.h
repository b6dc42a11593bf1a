// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Different vertices drawn at random; every set of them is equally likely. Vertices without edges are drawn only if no
/// others are left. The draw is the same on every machine. Cost O(V).
/// @param count  number of vertices; above V it is reduced to V
std::vector<std::uint32_t> random_vertices(const Vertex_graph& graph, std::size_t count, std::uint64_t seed);

/// Options of Random_voronoi.
struct Random_voronoi_options {
  std::uint64_t seed = 1;  ///< of the draw
};

/// Partition strategy: the vertices nearest along the edges to each of N vertices drawn at random. See
/// `Geodesic_voronoi`.
///
/// Vertices of a component in which none was drawn go to the seeds nearest in a straight line. O((V + E) log V).
struct Random_voronoi {
  static constexpr std::string_view name = "random_voronoi";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;                 ///< see Partition_strategy

  Random_voronoi_options options = {};  ///< the seed

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
