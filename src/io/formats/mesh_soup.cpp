// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/mesh_soup.h"

#include <cstdint>
#include <numeric>

namespace lodestone {

Joined_vertices joined_of(std::span<const std::uint32_t> first_of, std::span<const Corners> faces) {
  Joined_vertices joined(first_of.size());
  std::iota(joined.begin(), joined.end(), 0U);
  bool any = false;
  for (const auto& face : faces)
    for (const auto vertex : face) {
      joined[vertex] = first_of[vertex];
      any |= first_of[vertex] != vertex;
    }
  return any ? joined : Joined_vertices();
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
