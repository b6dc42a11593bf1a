// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/used_surface.h"

#include <limits>
#include <utility>

namespace lodestone {

Used_surface::Used_surface(const Numbered_surface& surface) : whole_(surface) {
  const auto count = static_cast<std::uint32_t>(num_vertices(surface.graph));
  for (std::uint32_t v = 0; v < count; ++v)
    if (is_used(surface.graph, v)) vertices_.push_back(v);
  if (vertices_.empty() || vertices_.size() == count) {
    vertices_.clear();
    return;
  }
  constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renumbered(count, unused);
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) renumbered[vertices_[i]] = i;
  std::vector<Corners> faces;
  faces.reserve(surface.faces.size());
  for (const auto& [a, b, c] : surface.faces)
    if (renumbered[a] != unused) faces.push_back({renumbered[a], renumbered[b], renumbered[c]});
  Vertex_graph graph = vertex_graph(static_cast<std::uint32_t>(vertices_.size()), faces);
  part_.emplace(Part{surface.positions(vertices_, Eigen::all), std::move(faces), std::move(graph)});
}

Feature_vectors Used_surface::rows_of_all_vertices(Feature_vectors rows) const {
  if (is_whole() || rows.size() == 0) return rows;
  Feature_vectors all = Feature_vectors::Zero(static_cast<Eigen::Index>(num_vertices(whole_.graph)), rows.cols());
  all(vertices_, Eigen::all) = rows;
  return all;
}

std::vector<Region_index> Used_surface::labels_of_all_vertices(std::vector<Region_index> labels) const {
  if (is_whole()) return labels;
  std::vector<Region_index> all(num_vertices(whole_.graph), 0);
  for (std::size_t i = 0; i < vertices_.size(); ++i) all[vertices_[i]] = labels[i];
  return all;
}

}  // namespace lodestone
