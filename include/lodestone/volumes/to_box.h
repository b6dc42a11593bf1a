// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/mesh/box.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Middle of a box. The coordinates are halved before they are added, since a sum may overflow.
inline Eigen::Vector3d centre_of(const Aabb& box) {
  return {box.low[0] / 2 + box.high[0] / 2, box.low[1] / 2 + box.high[1] / 2, box.low[2] / 2 + box.high[2] / 2};
}

/// Converts a box from Eigen's type.
inline Aabb to_aabb(const Box& box) {
  Aabb aabb{};
  for (int axis = 0; axis < 3; ++axis) {
    aabb.low[axis] = box.min()[axis];
    aabb.high[axis] = box.max()[axis];
  }
  return aabb;
}

/// Converts a box to Eigen's type.
inline Box to_box(const Aabb& box) {
  return {Eigen::Vector3d(box.low[0], box.low[1], box.low[2]), Eigen::Vector3d(box.high[0], box.high[1], box.high[2])};
}

}  // namespace lodestone
