// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// What is to be known of triangles before they are trusted.
struct Surface_report {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t components = 0;          ///< pieces of faces that share vertices
  std::size_t unused_vertices = 0;     ///< that no face names
  std::size_t duplicate_vertices = 0;  ///< that lie where one with a lower number lies
  std::size_t degenerate_faces = 0;    ///< without area, decided exactly
  std::size_t border_edges = 0;        ///< of one face
  std::size_t non_manifold_edges = 0;  ///< of three faces or more
  bool closed = false;                 ///< every edge has an even number of faces: there is an inside
  Box box;                             ///< of all vertices that faces use
};

/// Looks at triangles as they are in a file. O((V + F) log(V + F)).
/// @param points  finite
/// @param faces   vertex numbers below the number of points
Surface_report inspect_surface(std::span<const Point> points, std::span<const Corners> faces);

}  // namespace lodestone
