// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/senin.h"

#include <algorithm>
#include <random>
#include <unordered_set>

#include "lodestone/mesh/errors.h"
#include "partition/draw_without_repetition.h"

namespace lodestone {

namespace {

/// The vertices whose offset from the mean of all of them along a direction is at least half of the largest.
std::vector<std::uint32_t> farthest_along(const Eigen::Vector3d& direction, const std::vector<std::uint32_t>& vertices,
                                          const Positions& positions) {
  const Positions at = positions(vertices, Eigen::all);
  const Eigen::VectorXd along = (at.rowwise() - at.colwise().mean()) * direction;
  const double largest = along.maxCoeff(), least = std::min(largest, largest / 2);  // rounded means can exceed all
  std::vector<std::uint32_t> farthest;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (along[static_cast<Eigen::Index>(i)] >= least) farthest.push_back(vertices[i]);
  return farthest;
}

}  // namespace

void check(const Senin_options& options) {
  if (options.side && !(options.side->allFinite() && !options.side->isZero(0)))
    throw Bad_argument("the side on which particles are scattered must be a finite direction");
}

std::vector<std::uint32_t> scatter_particles(const Vertex_graph& graph, const Positions& positions,
                                             std::size_t particles, const Senin_options& options) {
  check(options);
  std::vector<std::uint32_t> drawn;
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    if (out_degree(v, graph) > 0) drawn.push_back(v);
  if (options.side && !drawn.empty()) drawn = farthest_along(*options.side, drawn, positions);

  std::mt19937_64 random(options.seed);
  drawn.resize(draw_without_repetition(drawn, particles, random));
  return drawn;
}

std::size_t default_rings(std::size_t vertices, std::size_t particles) {
  const std::size_t wanted = vertices / std::max<std::size_t>(particles, 1);
  std::size_t rings = 1;
  while (3 * rings * (rings + 1) + 1 < wanted) ++rings;
  return rings;
}

Patch ring_patch(const Vertex_graph& graph, const Vertex_faces& vertex_faces, std::span<const Corners> corners,
                 std::uint32_t centre, std::size_t rings) {
  std::vector<std::uint32_t> reached{centre};
  std::unordered_set<std::uint32_t> seen{centre};
  std::size_t ring_begin = 0;
  for (std::size_t ring = 0; ring < rings && ring_begin < reached.size(); ++ring) {
    const std::size_t ring_end = reached.size();
    for (std::size_t i = ring_begin; i < ring_end; ++i)
      for (const std::uint32_t w : neighbours(graph, reached[i]))
        if (seen.insert(w).second) reached.push_back(w);
    ring_begin = ring_end;
  }
  std::vector<std::uint32_t> faces;
  for (const auto v : reached) {
    const auto at = vertex_faces.at(v);
    faces.insert(faces.end(), at.begin(), at.end());
  }
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return make_patch(std::move(faces), corners);
}

}  // namespace lodestone
