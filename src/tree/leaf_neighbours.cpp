// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/leaf_neighbours.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lodestone {

Leaf_neighbours::Leaf_neighbours(const Tree_layout& layout, std::span<const Corners> walked, std::size_t vertex_count)
    : leaf_of_(walked.size()), shared_(vertex_count), at_border_(walked.size()) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> last(vertex_count, none);
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    for (const auto face : layout.faces(leaf)) {
      leaf_of_[face] = leaf;
      for (const auto corner : walked[face]) {
        const std::uint32_t before = std::exchange(last[corner], leaf);
        if (before != none && before != leaf) shared_[corner] = true;
      }
    }
  for (std::size_t face = 0; face < walked.size(); ++face)
    at_border_[face] = std::ranges::count_if(walked[face], [&](auto corner) { return bool{shared_[corner]}; }) >= 2;
}

void Leaf_neighbours::list_beside(std::span<const Corners> walked, const Vertex_faces& vertex_faces, std::uint32_t face,
                                  std::vector<std::uint32_t>& leaves) const {
  if (!at_border_[face]) return;
  const Corners& corners = walked[face];
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const std::uint32_t from = corners[edge], to = corners[(edge + 1) % 3];
    if (!shared_[from] || !shared_[to]) continue;
    auto fewer = vertex_faces.at(from), more = vertex_faces.at(to);
    if (more.size() < fewer.size()) std::swap(fewer, more);
    for (const auto other : fewer)
      if (leaf_of(other) != leaf_of(face) && std::ranges::binary_search(more, other)) leaves.push_back(leaf_of(other));
  }
}

}  // namespace lodestone
