// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/indexed_mesh.h"

#include <algorithm>
#include <string>

namespace lodestone {

Indexed_mesh::Indexed_mesh(Coordinates coordinates, std::span<const Corners> faces)
    : coordinates_(coordinates), faces_(faces) {
  if (coordinates.size() % 3 != 0)
    throw Bad_mesh("there are " + std::to_string(coordinates.size()) + " coordinates, which is not three per vertex");
  const std::size_t vertices = coordinates.size() / 3;
  for (const auto& corners : faces) {
    const std::uint32_t highest = std::ranges::max(corners);
    if (highest >= vertices)
      throw Bad_mesh("face " + std::to_string(&corners - faces.data()) + " refers to vertex " +
                     std::to_string(highest) + " of " + std::to_string(vertices));
  }
}

void Indexed_mesh::set_coordinates(Coordinates coordinates) {
  if (coordinates.size() != coordinates_.size())
    throw Bad_mesh("the mesh has " + std::to_string(coordinates_.size()) + " coordinates, but got " +
                   std::to_string(coordinates.size()));
  coordinates_ = coordinates;
}

}  // namespace lodestone
