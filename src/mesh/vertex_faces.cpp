// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/vertex_faces.h"

namespace lodestone {

Vertex_faces::Vertex_faces(std::uint32_t vertex_count, std::span<const Corners> corners)
    : offsets_(vertex_count + std::size_t{1}, 0), faces_(3 * corners.size()) {
  for (const auto& face : corners)
    for (const auto corner : face) ++offsets_[corner + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) offsets_[v + 1] += offsets_[v];
  auto next = offsets_;
  for (std::uint32_t face = 0; face < corners.size(); ++face)
    for (const auto corner : corners[face]) faces_[next[corner]++] = face;
}

}  // namespace lodestone
