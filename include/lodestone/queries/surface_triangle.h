// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/mesh/object_surface.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// The triangle of a face of a surface, where its corners are now.
inline Triangle surface_triangle(const Object_surface& surface, std::uint32_t face) {
  return face_triangle(surface.corners()[face],
                       [&](auto vertex) { return surface.coordinates().data() + 3 * std::size_t{vertex}; });
}

}  // namespace lodestone
