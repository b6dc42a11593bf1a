// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// The corners of the face with the given index in a leaf's list.
inline Triangle_corners leaf_triangle(const Leaf_faces& leaf, std::size_t index) {
  const auto [p, q, r] = leaf.corners[index];
  return {leaf.position(p), leaf.position(q), leaf.position(r)};
}

/// Whether two faces are contacts: nearer than a distance, or without one intersecting.
/// @param likely  where they cross, if they do
inline bool are_in_contact(const Triangle_corners& a, const Triangle_corners& b, double distance, Crossing likely) {
  return distance > 0 ? triangles_nearer_than(triangle_of(a), triangle_of(b), distance)
                      : triangles_intersect_given(a, b, likely);
}

}  // namespace lodestone
