// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/walked_surface.h"

#include "lodestone/mesh/check_finite.h"

namespace lodestone {

Read_face read_face(const Walked_surface& surface, std::uint32_t face) {
  Read_face read{.face = face, .triangle = {}, .box = {}};
  for (int corner = 0; corner < 3; ++corner) {
    const std::uint32_t vertex = surface.faces[face][corner];
    const Eigen::Vector3d position = surface.position(vertex);
    if (!position.allFinite()) fail_not_finite(vertex);
    read.triangle[corner] = Point(position.x(), position.y(), position.z());
    read.box.extend(position);
  }
  return read;
}

}  // namespace lodestone
