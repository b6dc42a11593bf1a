// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Unit normal and area of each face, in units in which the longest side of the surface's bounding box is 1. Both are 0
/// if the area is no more than rounding.
struct Face_geometry {
  Positions normals;  ///< F x 3
  std::vector<double> areas;
};

Face_geometry face_geometry(const Numbered_surface& surface);

}  // namespace lodestone
