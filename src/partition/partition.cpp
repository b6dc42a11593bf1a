// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/partition.h"

#include <algorithm>
#include <string>

#include "lodestone/mesh/errors.h"
#include "partition/used_surface.h"

namespace lodestone {

Feature_vectors Numbered_surface::picked_rows(const Feature_vectors& all) const {
  if (all.size() == 0) return all;
  const auto vertices = mesh_vertices.empty() ? positions.rows() : static_cast<Eigen::Index>(mesh_vertex_count);
  if (all.rows() != vertices)
    throw Bad_argument("extra factors have " + std::to_string(all.rows()) + " rows for " + std::to_string(vertices) +
                       " vertices: they are of one mesh, with a row for each of its vertices");
  return mesh_vertices.empty() ? all : Feature_vectors(all(mesh_vertices, Eigen::all));
}

namespace {

void check(const Labelling& labelling, std::size_t vertices) {
  if (labelling.labels.size() != vertices)
    throw Bad_argument("the strategy labelled " + std::to_string(labelling.labels.size()) + " of " +
                       std::to_string(vertices) + " vertices");
  const auto wrong = std::ranges::find_if(labelling.labels, [&](auto label) { return label >= vertices; });
  if (wrong != labelling.labels.end())
    throw Bad_argument("the strategy gave vertex " + std::to_string(wrong - labelling.labels.begin()) + " the label " +
                       std::to_string(*wrong) + ", which is not below the number of vertices, " +
                       std::to_string(vertices));
  if (labelling.vectors.size() != 0 && static_cast<std::size_t>(labelling.vectors.rows()) != vertices)
    throw Bad_argument("the strategy gave " + std::to_string(labelling.vectors.rows()) + " vectors for " +
                       std::to_string(vertices) + " vertices");
}

/// A strategy that gives more labels than any limit allows does not go by the wanted number; nor does its limit.
std::size_t wanted_for_limit(std::size_t wanted, std::size_t labels) {
  return labels > most_regions(wanted) ? labels : wanted;
}

/// `feature_vectors`; those of vertices without edges are 0, and do not count for the others.
Feature_vectors used_feature_vectors(const Numbered_surface& surface) {
  const Used_surface used(surface);
  return used.rows_of_all_vertices(feature_vectors(used.surface().positions, used.surface().faces));
}

/// The vertex of each region that is nearest to the region's mean vector. Ties go to the lowest index. Vertices without
/// edges are skipped. V distances, each of O(k) for k components.
/// @param vectors  V x k
std::vector<std::uint32_t> start_vertices(const Vertex_graph& graph, const Feature_vectors& vectors,
                                          const std::vector<Region_index>& labels, std::size_t regions) {
  Feature_vectors means = Feature_vectors::Zero(static_cast<Eigen::Index>(regions), vectors.cols());
  std::vector<std::size_t> sizes(regions, 0);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (out_degree(v, graph) == 0) continue;
    means.row(labels[v]) += vectors.row(v);
    ++sizes[labels[v]];
  }
  for (std::size_t region = 0; region < regions; ++region)
    if (sizes[region] > 0) means.row(region) /= static_cast<double>(sizes[region]);

  std::vector<std::uint32_t> particles(regions, 0);
  std::vector<double> nearest(regions, std::numeric_limits<double>::infinity());
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (out_degree(v, graph) == 0) continue;
    const double distance = (vectors.row(v) - means.row(labels[v])).squaredNorm();
    if (distance < nearest[labels[v]]) {
      nearest[labels[v]] = distance;
      particles[labels[v]] = v;
    }
  }
  return particles;
}

}  // namespace

Numbered_partition finish_partition(const Vertex_graph& graph, const Positions& positions,
                                    std::span<const Corners> faces, Labelling labelling, std::size_t wanted,
                                    const Partition_options& options) {
  check(labelling, num_vertices(graph));
  Numbered_partition result;
  result.labels = std::move(labelling.labels);
  result.statistics.iterations = labelling.iterations;
  result.statistics.distance_evaluations = labelling.distance_evaluations;

  // A strategy may leave out labels. They are no regions.
  const std::size_t labels = 1 + *std::ranges::max_element(result.labels);
  result.regions = drop_regions_without_edges(graph, result.labels, labels);
  auto& repair = result.statistics.repair;
  if (options.keep_islands)
    repair = {.regions = result.regions, .parts_before = count_parts(graph, result.labels)};
  else
    repair = repair_islands(graph, result.labels, result.regions, wanted_for_limit(wanted, result.regions));
  result.regions = repair.regions;

  if (labelling.vectors.size() == 0) labelling.vectors = used_feature_vectors({graph, positions, faces});
  result.particles = start_vertices(graph, labelling.vectors, result.labels, result.regions);
  return result;
}

}  // namespace lodestone
