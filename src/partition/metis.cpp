// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/metis.h"

#include <CGAL/boost/graph/METIS/partition_graph.h>

#include <algorithm>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <limits>
#include <mutex>

#include "lodestone/partition/oriented_mesh.h"
#include "lodestone/partition/region_count.h"
#include "partition/refusals.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

void check(const Numbered_surface& surface, const Metis_options& options) {
  if (!(options.imbalance >= 0.001 && options.imbalance <= 1))
    throw Bad_argument("METIS: the imbalance must be between 0.001 and 1");
  if (options.refinements < 1 || options.refinements > 1000)
    throw Bad_argument("METIS: the number of refinements must be between 1 and 1000");
  if (options.vertices_a_part < 2 || options.vertices_a_part > 1000)
    throw Bad_argument("METIS: vertices_a_part must be between 2 and 1000");
  // METIS counts both directions of the three edges of every face in one of its integers.
  if (surface.faces.size() > static_cast<std::size_t>(std::numeric_limits<idx_t>::max()) / 6)
    throw Bad_argument("METIS: the mesh has too many faces");
}

/// The option array of METIS.
struct Metis_array {
  idx_t values[METIS_NOPTIONS];

  explicit Metis_array(const Metis_options& options) {
    METIS_SetDefaultOptions(values);
    values[METIS_OPTION_PTYPE] = options.method == Metis_method::k_way ? METIS_PTYPE_KWAY : METIS_PTYPE_RB;
    values[METIS_OPTION_SEED] = static_cast<idx_t>(options.seed & 0x7fffffff);
    values[METIS_OPTION_NITER] = static_cast<idx_t>(options.refinements);
    values[METIS_OPTION_UFACTOR] = static_cast<idx_t>(std::lround(1000 * options.imbalance));
  }
};

/// The part of each vertex of a mesh. There are at least two parts.
std::vector<Region_index> parts_of(const Surface_mesh& mesh, std::size_t parts, const Metis_options& options) {
  std::vector<Region_index> labels(mesh.number_of_vertices(), 0);
  Metis_array array(options);
  static std::mutex random_numbers;
  const std::scoped_lock lock(random_numbers);
  CGAL::METIS::partition_graph(
      mesh, static_cast<int>(parts),
      CGAL::parameters::METIS_options(&array.values)
          .vertex_partition_id_map(boost::make_iterator_property_map(labels.begin(), get(boost::vertex_index, mesh))));
  return labels;
}

}  // namespace

Labelling Metis::label(const Numbered_surface& surface, std::size_t regions) const {
  check(surface, options);
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    std::vector<Region_index> labels(num_vertices(used.graph), 0);
    const std::size_t parts = std::min(wanted, labels.size() / options.vertices_a_part);
    // Where one vertex of a used surface has edges, all have.
    if (parts > 1 && num_edges(used.graph) > 0)
      labels = with_refusals_as_bad_mesh(name, [&] { return parts_of(oriented_mesh(used).mesh, parts, options); });
    labels.resize(num_vertices(used.graph));  // drops the copies that `oriented_mesh` makes of vertices
    adjust_region_count(used.graph, used.positions, labels, wanted);
    return {.labels = std::move(labels)};
  });
}

}  // namespace lodestone
