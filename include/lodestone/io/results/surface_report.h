// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// The properties of a triangle surface that decide what can be expected of it.
struct Surface_report {
  std::size_t vertices = 0;            ///< those of no face included
  std::size_t faces = 0;               ///< number of triangles
  std::size_t components = 0;          ///< sets of faces connected through shared vertices
  std::size_t unused_vertices = 0;     ///< vertices of no face
  std::size_t duplicate_vertices = 0;  ///< vertices with the position of one with a lower index
  std::size_t degenerate_faces = 0;    ///< faces of zero area, decided exactly
  std::size_t border_edges = 0;        ///< edges of one face
  std::size_t non_manifold_edges = 0;  ///< edges of three faces or more
  bool closed = false;                 ///< every edge has an even number of faces: the surface has an inside
  Box box;                             ///< of all vertices that faces use
};

/// Inspects triangles as a file lists them. O((V + F) log(V + F)).
/// @param points  finite
/// @param faces   vertex indices, each below the number of points
Surface_report inspect_surface(std::span<const Point> points, std::span<const Corners> faces);

}  // namespace lodestone
