// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/faces_in_box.h"

#include "mesh/positions_kernel.h"

namespace lodestone {

bool bound_positions(Coordinates coordinates, Box& box) {
  return kernel::bound_positions(coordinates.data(), coordinates.size() / 3, box.min().data(), box.max().data());
}

std::uint8_t sides_beyond(const double* position, const Box& box) {
  std::uint8_t sides = 0;
  kernel::sides_beyond(position, 1, box.min().data(), box.max().data(), &sides);
  return sides;
}

Unset_vector<std::uint8_t> sides_beyond(Coordinates coordinates, const Box& box) {
  Unset_vector<std::uint8_t> sides;
  sides_beyond(coordinates, box, sides);
  return sides;
}

void sides_beyond(Coordinates coordinates, const Box& box, Unset_vector<std::uint8_t>& sides) {
  sides.resize(coordinates.size() / 3);
  kernel::sides_beyond(coordinates.data(), sides.size(), box.min().data(), box.max().data(), sides.data());
}

void select_faces(const Faces_in_box& faces, const Box& part, Faces_in_box& found) {
  const auto beyond = sides_beyond(faces.coordinates, part);
  found.coordinates = faces.coordinates;
  for (std::size_t i = 0; i < faces.faces.size(); ++i) {
    const auto& [p, q, r] = faces.corners[i];
    if ((beyond[p] & beyond[q] & beyond[r]) != 0) continue;
    found.faces.push_back(faces.faces[i]);
    found.corners.push_back(faces.corners[i]);
  }
}

}  // namespace lodestone
