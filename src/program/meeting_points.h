// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Where two triangles meet; of two that are apart the nearest point of each.
inline Intersection_points meeting_points(const Triangle& a, const Triangle& b) {
  if (triangles_intersect(a, b)) return triangle_intersection(a, b);
  const Closest_points nearest = closest_points(a, b);
  return {nearest.a, nearest.b};
}

}  // namespace lodestone
