// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/mesh_soup.h"

#include <cstdint>

namespace lodestone {

Joined_vertices if_any_joined(Joined_vertices first_of) {
  for (std::uint32_t vertex = 0; vertex < first_of.size(); ++vertex)
    if (first_of[vertex] != vertex) return first_of;
  return {};
}

std::vector<Corners> corners_of(const Mesh_soup& soup) {
  std::vector<Corners> corners;
  corners.reserve(soup.faces.size());
  for (const auto& face : soup.faces)
    corners.push_back({static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[1]),
                       static_cast<std::uint32_t>(face[2])});
  return corners;
}

}  // namespace lodestone
