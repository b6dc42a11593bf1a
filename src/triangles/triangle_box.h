// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/mesh/box.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// The box of the corners, exact.
inline Box box_of(const Triangle& triangle) {
  Box box;
  for (const Point& corner : triangle) box.extend(Eigen::Vector3d(corner.x(), corner.y(), corner.z()));
  return box;
}

}  // namespace lodestone
