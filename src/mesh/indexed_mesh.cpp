// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/indexed_mesh.h"

#include <algorithm>
#include <string>

namespace lodestone {

Indexed_mesh::Indexed_mesh(Coordinates coordinates, std::span<const Corners> faces)
    : coordinates_(coordinates), faces_(faces) {
  if (coordinates.size() % 3 != 0)
    throw Bad_mesh("there are " + std::to_string(coordinates.size()) + " coordinates, which is not three per vertex");
  for (std::size_t face = 0; face < faces.size(); ++face) check_corners(static_cast<std::uint32_t>(face));
}

void Indexed_mesh::check_corners(std::uint32_t face) const {
  if (has_corners(face)) return;
  throw Bad_mesh("face " + std::to_string(face) + " refers to vertex " +
                 std::to_string(std::ranges::max(faces_[face])) + " of " + std::to_string(coordinates_.size() / 3));
}

Coordinates Indexed_mesh::first_points(std::size_t count) const {
  if (coordinates_.size() / 3 < count)
    throw Bad_mesh("there are " + std::to_string(coordinates_.size() / 3) + " points for " + std::to_string(count) +
                   " vertices");
  return coordinates_.first(3 * count);
}

void Indexed_mesh::set_coordinates(Coordinates coordinates) {
  if (coordinates.size() != coordinates_.size())
    throw Bad_mesh("the mesh has " + std::to_string(coordinates_.size()) + " coordinates, but got " +
                   std::to_string(coordinates.size()));
  coordinates_ = coordinates;
}

}  // namespace lodestone
