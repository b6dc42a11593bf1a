// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// The seeds from which centroidal cells are grown.
enum class Centroidal_start { farthest_points, random_vertices };

struct Centroidal_options {
  std::uint64_t seed = 1;  ///< of the draw of the first seeds
  Centroidal_start start = Centroidal_start::farthest_points;
  std::size_t max_iterations = 100;  ///< >= 1; seeds mostly settle in fewer
};

/// Seeds near the middle of their cells, and how they came there.
struct Centroidal_seeds {
  std::vector<std::uint32_t> vertices;  ///< those of the iteration of least energy
  std::vector<double> energies;         ///< before each iteration, and after the last: sum of area * distance^2
  bool settled = false;                 ///< the last iteration moved no seed
};

/// Lloyd iterations on a surface: cells of the seeds along the edges, then each seed moves to the vertex of its cell
/// that is nearest to the cell's centroid, until no seed moves.
///
/// Centroidal Voronoi tessellations \cite du1999, on meshes with geodesic distances \cite peyre2006. The centroid is
/// the mean position weighted by area, a third of each face to each corner; of a cell without area the plain mean. The
/// energy is the sum over the vertices of area times squared distance along the edges. An iteration takes distances
/// along the edges for the cells and straight ones for the centroid, so the energy mostly falls, but need not: the
/// seeds of least energy are returned. O((V + E) log V) per iteration.
///
/// @param surface  positions of a size at which fourth powers and the length of the longest path do not overflow
/// @param count    at most V; more are cut down to V
/// @throws Bad_argument  an option out of range
Centroidal_seeds centroidal_seeds(const Numbered_surface& surface, std::size_t count,
                                  const Centroidal_options& options = {});

/// Partition strategy: the vertices nearest along the edges to each of N `centroidal_seeds`. See `Geodesic_voronoi`.
struct Centroidal {
  static constexpr std::string_view name = "centroidal";

  Centroidal_options options = {};

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
