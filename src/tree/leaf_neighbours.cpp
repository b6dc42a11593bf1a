// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/leaf_neighbours.h"

#include <algorithm>

namespace lodestone {

namespace {

/// A leaf beside a face.
struct Beside {
  std::uint32_t face, leaf;
};

/// Lists which leaves are beside which faces, edge by edge.
class Edge_search {
 public:
  /// @param neighbours  knows the leaf of each face
  Edge_search(std::span<const Corners> walked, const Vertex_faces& vertex_faces, const Leaf_neighbours& neighbours)
      : walked_(walked), vertex_faces_(vertex_faces), neighbours_(neighbours) {}

  /// Appends those of the edges from a vertex to others of higher index.
  void list(std::uint32_t vertex, std::vector<Beside>& beside);

 private:
  /// A face at an edge from the vertex.
  struct Edge_face {
    std::uint32_t to, leaf, face;
    friend auto operator<=>(const Edge_face&, const Edge_face&) = default;
  };

  bool is_inside_a_leaf(std::uint32_t vertex) const;
  void list_edge(std::span<const Edge_face> faces, std::vector<Beside>& beside);

  std::span<const Corners> walked_;
  const Vertex_faces& vertex_faces_;
  const Leaf_neighbours& neighbours_;
  std::vector<Edge_face> around_;
  std::vector<std::uint32_t> leaves_;
};

bool Edge_search::is_inside_a_leaf(std::uint32_t vertex) const {
  const auto faces = vertex_faces_.at(vertex);
  return std::ranges::all_of(
      faces, [&](auto face) { return neighbours_.leaf_of(face) == neighbours_.leaf_of(faces.front()); });
}

void Edge_search::list(std::uint32_t vertex, std::vector<Beside>& beside) {
  if (is_inside_a_leaf(vertex)) return;
  around_.clear();
  for (const auto face : vertex_faces_.at(vertex))
    for (const auto to : walked_[face])
      if (to > vertex) around_.push_back({to, neighbours_.leaf_of(face), face});
  std::ranges::sort(around_);
  for (std::size_t first = 0, end = 0; first < around_.size(); first = end) {
    while (end < around_.size() && around_[end].to == around_[first].to) ++end;
    if (around_[first].leaf != around_[end - 1].leaf) list_edge(std::span(around_).subspan(first, end - first), beside);
  }
}

/// @param faces  all at one edge, those of each leaf together
void Edge_search::list_edge(std::span<const Edge_face> faces, std::vector<Beside>& beside) {
  leaves_.clear();
  for (const auto& at : faces)
    if (leaves_.empty() || leaves_.back() != at.leaf) leaves_.push_back(at.leaf);
  const std::size_t others = std::min(leaves_.size() - 1, Leaf_neighbours::most_per_edge);
  std::size_t own = 0;
  for (const auto& at : faces) {
    if (leaves_[own] != at.leaf) ++own;
    for (std::size_t i = 1; i <= others; ++i) beside.push_back({at.face, leaves_[(own + i) % leaves_.size()]});
  }
}

}  // namespace

Leaf_neighbours::Leaf_neighbours(const Tree_layout& layout, std::span<const Corners> walked,
                                 const Vertex_faces& vertex_faces)
    : faces_(walked.size() + 1) {
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    for (const auto face : layout.faces(leaf)) faces_[face].leaf = leaf;
  std::vector<Beside> beside;
  Edge_search edges(walked, vertex_faces, *this);
  for (std::uint32_t vertex = 0; vertex < vertex_faces.vertex_count(); ++vertex) edges.list(vertex, beside);

  // Sorted by faces, by counting.
  for (const auto& [face, leaf] : beside) ++faces_[face].first;
  std::uint32_t sum = 0;
  for (auto& face : faces_) face.first = sum += face.first;
  beside_.resize(beside.size());
  for (const auto& [face, leaf] : beside) beside_[--faces_[face].first] = leaf;
}

}  // namespace lodestone
