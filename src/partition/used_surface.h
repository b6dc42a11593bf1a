// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Whether a vertex is on an edge of a face.
inline bool is_used(const Vertex_graph& graph, std::uint32_t vertex) { return out_degree(vertex, graph) > 0; }

/// A surface without the vertices that have no edges: these may lie anywhere, and say nothing about its shape. The
/// surface as it is if all have edges, or none has. The others keep their order. O(V + F).
class Used_surface {
 public:
  /// @param surface  must outlive this
  explicit Used_surface(const Numbered_surface& surface);
  Used_surface(const Used_surface&) = delete;
  Used_surface& operator=(const Used_surface&) = delete;

  /// Whether it is the surface as it was.
  bool is_whole() const { return !part_; }
  /// Vertices and faces numbered anew. A face without edges is left out.
  Numbered_surface surface() const {
    return part_ ? Numbered_surface{part_->graph, part_->positions, part_->faces} : whole_;
  }
  /// Per vertex of `surface()`: its index before. Empty if the surface is whole.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }

  /// The rows of the vertices of `surface()`, from those of all.
  Feature_vectors picked_rows(const Feature_vectors& all) const {
    return is_whole() || all.size() == 0 ? all : Feature_vectors(all(vertices_, Eigen::all));
  }
  /// Rows for all vertices; 0 for those without edges.
  Feature_vectors rows_of_all_vertices(Feature_vectors rows) const;
  /// Labels of all vertices; 0 for those without edges.
  std::vector<Region_index> labels_of_all_vertices(std::vector<Region_index> labels) const;

 private:
  struct Part {
    Positions positions;
    std::vector<Corners> faces;
    Vertex_graph graph;
  };

  Numbered_surface whole_;
  std::vector<std::uint32_t> vertices_;
  std::optional<Part> part_;
};

/// What `label(surface, regions)` returns for the used part of a surface, for all its vertices.
template <class Label>
Labelling label_used(const Used_surface& used, std::size_t regions, const Label& label) {
  if (used.is_whole()) return label(used.surface(), regions);
  Labelling labelling = label(used.surface(), std::min(regions, used.vertices().size()));
  labelling.labels = used.labels_of_all_vertices(std::move(labelling.labels));
  labelling.vectors = used.rows_of_all_vertices(std::move(labelling.vectors));
  return labelling;
}

/// The same, where nothing else is asked of the used part.
template <class Label>
Labelling label_used(const Numbered_surface& surface, std::size_t regions, const Label& label) {
  return label_used(Used_surface(surface), regions, label);
}

}  // namespace lodestone
