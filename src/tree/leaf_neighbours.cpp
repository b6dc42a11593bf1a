// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/leaf_neighbours.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lodestone {

namespace {

/// V: whether the faces at a vertex are in several leaves.
std::vector<bool> shared_vertices(const Tree_layout& layout, std::span<const Corners> walked,
                                  std::size_t vertex_count) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<bool> shared(vertex_count);
  std::vector<std::uint32_t> last(vertex_count, none);
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    for (const auto face : layout.faces(leaf))
      for (const auto corner : walked[face]) {
        const std::uint32_t before = std::exchange(last[corner], leaf);
        if (before != none && before != leaf) shared[corner] = true;
      }
  return shared;
}

/// A leaf beside a face.
struct Beside {
  std::uint32_t face, leaf;
};

/// Lists which leaves are beside which faces, edge by edge.
class Edge_search {
 public:
  Edge_search(std::span<const Corners> walked, const Vertex_faces& vertex_faces, std::span<const std::uint32_t> leaf_of)
      : walked_(walked), vertex_faces_(vertex_faces), leaf_of_(leaf_of) {}

  /// Appends those of the edges from a vertex to others of higher index.
  void list(std::uint32_t vertex, const std::vector<bool>& shared, std::vector<Beside>& beside);

 private:
  /// A face at an edge from the vertex.
  struct Edge_face {
    std::uint32_t to, leaf, face;
    friend auto operator<=>(const Edge_face&, const Edge_face&) = default;
  };

  void list_edge(std::span<const Edge_face> faces, std::vector<Beside>& beside);

  std::span<const Corners> walked_;
  const Vertex_faces& vertex_faces_;
  std::span<const std::uint32_t> leaf_of_;
  std::vector<Edge_face> around_;
  std::vector<std::uint32_t> leaves_;
};

void Edge_search::list(std::uint32_t vertex, const std::vector<bool>& shared, std::vector<Beside>& beside) {
  around_.clear();
  for (const auto face : vertex_faces_.at(vertex))
    for (const auto to : walked_[face])
      if (to > vertex && shared[to]) around_.push_back({to, leaf_of_[face], face});
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
  std::vector<std::uint32_t> leaf_of(walked.size());
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    for (const auto face : layout.faces(leaf)) leaf_of[face] = leaf;
  const auto shared = shared_vertices(layout, walked, vertex_faces.vertex_count());
  std::vector<Beside> beside;
  Edge_search edges(walked, vertex_faces, leaf_of);
  for (std::uint32_t vertex = 0; vertex < vertex_faces.vertex_count(); ++vertex)
    if (shared[vertex]) edges.list(vertex, shared, beside);

  // Sorted by faces, by counting.
  for (const auto& [face, leaf] : beside) ++faces_[face].first;
  std::uint32_t sum = 0;
  for (auto& face : faces_) face.first = sum += face.first;
  beside_.resize(beside.size());
  for (const auto& [face, leaf] : beside) beside_[--faces_[face].first] = leaf;
  for (std::size_t face = 0; face < walked.size(); ++face) faces_[face].leaf = leaf_of[face];
}

}  // namespace lodestone
