// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// How the first seeds of centroidal cells are chosen.
enum class Centroidal_start {
  farthest_points,  ///< far apart along the edges: `farthest_points`
  random_vertices,  ///< drawn at random: `random_vertices`
};

/// Options of `centroidal_seeds`.
struct Centroidal_options {
  std::uint64_t seed = 1;                                      ///< of the draw of the first seeds
  Centroidal_start start = Centroidal_start::farthest_points;  ///< where the first seeds are
  std::size_t max_iterations = 100;                            ///< >= 1; the seeds mostly settle in fewer
};

/// Seeds near the centroids of their cells, and the course of the iterations.
struct Centroidal_seeds {
  std::vector<std::uint32_t> vertices;  ///< the seeds of the iteration with the least energy
  std::vector<double> energies;         ///< before each iteration, and after the last: sum of area * distance^2
  bool settled = false;                 ///< whether the last iteration moved no seed
};

/// Lloyd iterations on a surface, until no seed moves. Each iteration assigns every vertex to the seed that is nearest
/// along the edges. Then it moves each seed to the vertex of its cell that is nearest to the centroid of the cell.
///
/// Centroidal Voronoi tessellations \cite du1999, on meshes with geodesic distances \cite peyre2006. The centroid is
/// the mean position weighted by area, where a third of each face belongs to each corner. The centroid of a cell
/// without area is the plain mean. The energy is the sum over the vertices of area times squared distance along the
/// edges. An iteration measures along the edges to find the cells, but in a straight line to find the vertex nearest to
/// the centroid. So the energy mostly falls, but it need not; the seeds of least energy are returned. O((V + E) log V)
/// per iteration.
///
/// @param surface  positions whose fourth powers do not overflow, nor does the length of the longest path
/// @param count    number of seeds; above V it is reduced to V
/// @throws Bad_argument  an option out of range
Centroidal_seeds centroidal_seeds(const Numbered_surface& surface, std::size_t count,
                                  const Centroidal_options& options = {});

/// Partition strategy: the vertices nearest along the edges to each of N `centroidal_seeds`. See `Geodesic_voronoi`.
struct Centroidal {
  static constexpr std::string_view name = "centroidal";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;             ///< see Partition_strategy

  Centroidal_options options = {};  ///< of `centroidal_seeds`

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
