// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/leaf_neighbours.h"

#include <algorithm>

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
  if (vertex_faces_->at(v).size() <= many) {
    find_leaves_at(v, w, leaves_);
    return leaves_;
  }
  if (crowded_leaves_.empty() || crowded_ != std::pair(v, w)) find_leaves_at(v, w, crowded_leaves_);
  crowded_ = {v, w};
  return crowded_leaves_;
}

/// @param few  the end of the edge with fewer faces
void Leaf_neighbours::find_leaves_at(std::uint32_t few, std::uint32_t other, std::vector<std::uint32_t>& leaves) const {
  leaves.clear();
  for (const auto face : vertex_faces_->at(few))
    if (std::ranges::find(walked_[face], other) != walked_[face].end()) leaves.push_back(leaf_of(face));
  std::ranges::sort(leaves);
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
}

}  // namespace lodestone
