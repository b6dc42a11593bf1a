// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "lodestone/contact/volumes/aabb.h"

namespace lodestone {

/// Axis-aligned box. Minima and maxima of coordinates are exact, so two boxes that do not overlap prove their contents
/// apart.
using Box = Eigen::AlignedBox3d;

inline Box to_box(const Aabb& box) {
  return {Eigen::Vector3d(box.low[0], box.low[1], box.low[2]), Eigen::Vector3d(box.high[0], box.high[1], box.high[2])};
}

}  // namespace lodestone
