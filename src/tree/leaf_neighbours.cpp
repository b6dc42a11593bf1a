// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/leaf_neighbours.h"

#include <algorithm>
#include <utility>

namespace lodestone {

Leaf_neighbours::Leaf_neighbours(const Tree_layout& layout, std::size_t faces)
    : faces_(faces), known_(layout.leaf_count()) {
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    for (const auto face : layout.faces(leaf)) faces_[face].leaf = leaf;
}

void Leaf_neighbours::look_at(const Tree_layout& layout, std::span<const Corners> walked,
                              const Vertex_faces& vertex_faces) {
  layout_ = &layout;
  walked_ = walked;
  vertex_faces_ = &vertex_faces;
}

void Leaf_neighbours::list_leaf(std::uint32_t leaf) {
  for (const auto face : layout_->faces(leaf)) {
    const std::size_t first = beside_.size();
    beside_.push_back(0);
    const auto& [a, b, c] = walked_[face];
    list_edge(leaf, a, b);
    list_edge(leaf, b, c);
    list_edge(leaf, c, a);
    const std::size_t count = beside_.size() - first - 1;
    if (count == 0) {
      beside_.pop_back();
      continue;
    }
    beside_[first] = static_cast<std::uint32_t>(count);
    faces_[face].first = static_cast<std::uint32_t>(first);
  }
  known_[leaf] = true;
}

/// Lists the leaves that have faces at an edge, but for one: those that come next, in a ring.
void Leaf_neighbours::list_edge(std::uint32_t own, std::uint32_t v, std::uint32_t w) {
  if (v == w) return;
  const auto leaves = leaves_at(v, w);
  const std::size_t others = std::min(leaves.size() - 1, most_per_edge);
  const auto at = static_cast<std::size_t>(std::ranges::lower_bound(leaves, own) - leaves.begin());
  for (std::size_t i = 1; i <= others; ++i) beside_.push_back(leaves[(at + i) % leaves.size()]);
}

/// The leaves that have faces at an edge, sorted.
std::span<const std::uint32_t> Leaf_neighbours::leaves_at(std::uint32_t v, std::uint32_t w) {
  constexpr std::size_t many = 64;
  if (vertex_faces_->at(w).size() < vertex_faces_->at(v).size()) std::swap(v, w);
  if (vertex_faces_->at(v).size() > many) {
    const Crowd& crowd = crowd_at(v);
    const auto [first, last] = std::equal_range(crowd.ends.begin(), crowd.ends.end(), w);
    const auto leaf_of_end = [&](auto end) { return crowd.leaves.begin() + (end - crowd.ends.begin()); };
    return std::span(leaf_of_end(first), leaf_of_end(last));
  }
  leaves_.clear();
  for (const auto face : vertex_faces_->at(v))
    if (std::ranges::find(walked_[face], w) != walked_[face].end()) leaves_.push_back(leaf_of(face));
  std::ranges::sort(leaves_);
  leaves_.erase(std::unique(leaves_.begin(), leaves_.end()), leaves_.end());
  return leaves_;
}

/// To look through the faces of such a vertex for each of its edges would take time that grows with their square.
const Leaf_neighbours::Crowd& Leaf_neighbours::crowd_at(std::uint32_t vertex) {
  const auto known = crowds_.find(vertex);
  if (known != crowds_.end()) return known->second;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (const auto face : vertex_faces_->at(vertex))
    for (const auto end : walked_[face])
      if (end != vertex) all.emplace_back(end, leaf_of(face));
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  Crowd crowd;
  for (const auto& [end, leaf] : all) {
    crowd.ends.push_back(end);
    crowd.leaves.push_back(leaf);
  }
  return crowds_.emplace(vertex, std::move(crowd)).first->second;
}

}  // namespace lodestone
