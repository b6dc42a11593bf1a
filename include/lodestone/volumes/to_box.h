// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/mesh/box.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Converts a box to Eigen's type.
inline Box to_box(const Aabb& box) {
  return {Eigen::Vector3d(box.low[0], box.low[1], box.low[2]), Eigen::Vector3d(box.high[0], box.high[1], box.high[2])};
}

}  // namespace lodestone
