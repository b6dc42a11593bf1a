// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// The corners of the face with the given index in a leaf's list.
inline Triangle_corners leaf_triangle(const Leaf_faces& leaf, std::size_t index) {
  const auto [p, q, r] = leaf.corners[index];
  return {leaf.position(p), leaf.position(q), leaf.position(r)};
}

}  // namespace lodestone
