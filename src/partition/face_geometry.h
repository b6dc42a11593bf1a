// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Unit normal and area of each face, where the longest side of the surface's bounding box is 1. A face whose area is
/// no more than rounding has the normal 0 and the area 0.
struct Face_geometry {
  Positions normals;  ///< F x 3
  std::vector<double> areas;
};

Face_geometry face_geometry(const Numbered_surface& surface);

}  // namespace lodestone
