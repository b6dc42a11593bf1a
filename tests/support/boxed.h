// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/triangles/clearance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// A triangle as `clearance` takes it.
inline Boxed_triangle boxed(const Triangle& t) {
  Boxed_triangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.corners[i] = {t[i].x(), t[i].y(), t[i].z()};
    result.box.extend(result.corners[i]);
  }
  return result;
}

}  // namespace lodestone
