// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <concepts>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"
#include "lodestone/partition/feature_vectors.h"
#include "lodestone/partition/islands.h"

namespace lodestone {

/// A surface by index, independent of the mesh type. Strategies that need no more than this are compiled once, and give
/// the same labels on every mesh type.
struct Numbered_surface {
  const Vertex_graph& graph;       ///< of its edges, V vertices
  const Positions& positions;      ///< V x 3
  std::span<const Corners> faces;  ///< F
  /// If seams are closed: V, the vertex of the mesh that each stands for. Empty: they are those of the mesh.
  std::span<const std::uint32_t> mesh_vertices = {};
  std::size_t mesh_vertex_count = 0;  ///< of such a mesh

  /// Picks the rows of the vertices out of those of all vertices of the mesh.
  /// @throws Bad_argument  there is not one row per vertex of the mesh
  Feature_vectors picked_rows(const Feature_vectors& all) const;
};

/// Input of a partition strategy: the mesh, its vertices and faces by index, and the current positions.
template <Triangle_mesh Mesh>
struct Partition_input {
  const Mesh& mesh;                       ///< as the caller has it
  const Mesh_numbering<Mesh>& numbering;  ///< of its vertices and faces
  const Vertex_graph& graph;              ///< of its edges
  const Positions& positions;             ///< V x 3

  /// The same without the mesh.
  Numbered_surface surface() const { return {graph, positions, numbering.corners()}; }
};

/// Output of a partition strategy.
struct Labelling {
  std::vector<Region_index> labels;        ///< V: the region of each vertex, below V
  Feature_vectors vectors = {};            ///< V x k: the space in which particles are seeded; empty: position + normal
  std::size_t iterations = 0;              ///< of the strategy's main loop
  std::uint64_t distance_evaluations = 0;  ///< between a vector and a code vector; 0 without code vectors
};

/// A partition strategy: a name, and one call operator that takes a mesh and returns a label per vertex. `partition()`
/// does everything else for all strategies: checks, island repair, numbering of the regions, particles.
template <class Strategy, class Mesh>
concept Partition_strategy = requires(const Strategy& strategy, const Partition_input<Mesh>& input,
                                      std::size_t regions) {
  { strategy.name } -> std::convertible_to<std::string_view>;
  { strategy(input, regions) } -> std::same_as<Labelling>;
};

/// A strategy that needs no more than a surface by index.
template <class Strategy>
concept Labels_by_index = requires(const Strategy& strategy, const Numbered_surface& surface, std::size_t regions) {
  { strategy.label(surface, regions) } -> std::same_as<Labelling>;
};

/// Whether a detector may divide several surfaces by this strategy at once, in several threads: the strategy says so by
/// an optional member `is_concurrent`.
template <class Strategy>
constexpr bool is_concurrent(const Strategy& strategy) {
  if constexpr (Labels_by_index<Strategy> && requires { bool{strategy.is_concurrent}; }) return strategy.is_concurrent;
  return false;
}

/// Options of `partition()`, for any strategy.
struct Partition_options {
  bool keep_islands = false;  ///< leave the islands of regions as the strategy made them
};

/// What a strategy, and the repair after it, took.
struct Partition_statistics {
  std::size_t iterations = 0;              ///< see Labelling
  std::uint64_t distance_evaluations = 0;  ///< see Labelling
  Island_repair repair = {};               ///< of regions with several islands
};

/// A mesh divided into regions, by index. Each region holds one particle.
struct Numbered_partition {
  std::vector<Region_index> labels;      ///< V: region of each vertex
  std::size_t regions = 0;               ///< number of regions, each with at least one face
  std::vector<std::uint32_t> particles;  ///< per region: the vertex at which its particle starts
  Partition_statistics statistics = {};  ///< what it took
};

/// The same with the descriptors of the mesh; the labels are in the region map.
template <Triangle_mesh Mesh>
struct Partition {
  std::size_t regions = 0;               ///< number of regions, each with at least one face
  std::vector<Vertex<Mesh>> particles;   ///< per region: the vertex at which its particle starts
  Partition_statistics statistics = {};  ///< what it took
};

/// The steps that all strategies share: checks, repair, numbering of the regions, particles. Vertices without edges do
/// not count for the vectors.
/// @param wanted  number of regions that the strategy was asked for, from which the limit of `repair_islands` comes; 0:
///                the number of labels
/// @throws Bad_argument  the number of labels or vectors is not V, or a label is not below V
Numbered_partition finish_partition(const Vertex_graph& graph, const Positions& positions,
                                    std::span<const Corners> faces, Labelling labelling, std::size_t wanted,
                                    const Partition_options& options);

/// `partition()` on a mesh already numbered.
template <Triangle_mesh Mesh, Partition_strategy<Mesh> Strategy>
Numbered_partition partition_numbered(const Partition_input<Mesh>& input, std::size_t regions, const Strategy& strategy,
                                      const Partition_options& options = {}) {
  if (regions == 0) throw Bad_argument("the number of regions must be at least 1");
  const auto wanted = std::min<std::size_t>(regions, input.numbering.vertex_count());
  return finish_partition(input.graph, input.positions, input.numbering.corners(), strategy(input, wanted), wanted,
                          options);
}

/// The same for a surface by index.
template <Labels_by_index Strategy>
Numbered_partition partition_numbered(const Numbered_surface& surface, std::size_t regions, const Strategy& strategy,
                                      const Partition_options& options = {}) {
  if (regions == 0) throw Bad_argument("the number of regions must be at least 1");
  const auto wanted = std::min<std::size_t>(regions, num_vertices(surface.graph));
  return finish_partition(surface.graph, surface.positions, surface.faces, strategy.label(surface, wanted), wanted,
                          options);
}

/// Divides a surface into regions and places one particle in each.
///
/// Every vertex gets one region. Every region is non-empty and, unless `keep_islands` is set, connected in the mesh
/// graph; of a surface of very many components some stay islands, see `Island_repair::islands_left`. Its particle
/// starts at the vertex nearest to the region's mean vector, in the strategy's own space. Each connected component of
/// the mesh that no region reaches becomes an additional region, up to the limit of `repair_islands`.
///
/// Vertices that no face uses form no region. The strategies of the library do not look at them, wherever they are, and
/// give them to region 0.
///
/// @param regions     wanted number of regions, >= 1; above V it is reduced to V
/// @param region_map  vertex property map that receives the region of each vertex
/// @param np          `vertex_point_map`
/// @throws Bad_mesh      no face, a face that is not a triangle, a coordinate that is not finite
/// @throws Bad_argument  no region wanted, or an option of the strategy out of range
template <Triangle_mesh Mesh, Region_map<Mesh> Regions, Partition_strategy<Mesh> Strategy,
          class Named_parameters = CGAL::parameters::Default_named_parameters>
Partition<Mesh> partition(const Mesh& mesh, std::size_t regions, Regions region_map, const Strategy& strategy,
                          const Partition_options& options = {},
                          const Named_parameters& np = CGAL::parameters::default_values()) {
  const Mesh_numbering<Mesh> numbering(mesh);
  const Vertex_graph graph = vertex_graph(numbering.vertex_count(), numbering.corners());
  const Positions positions = read_positions(numbering, vertex_points(mesh, np));
  const auto result =
      partition_numbered(Partition_input<Mesh>{mesh, numbering, graph, positions}, regions, strategy, options);

  for (std::uint32_t v = 0; v < numbering.vertex_count(); ++v) put(region_map, numbering.vertex(v), result.labels[v]);
  std::vector<Vertex<Mesh>> particles;
  for (const auto v : result.particles) particles.push_back(numbering.vertex(v));
  return {.regions = result.regions, .particles = std::move(particles), .statistics = result.statistics};
}

}  // namespace lodestone
