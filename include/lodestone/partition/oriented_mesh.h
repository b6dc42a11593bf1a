// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// A surface as the mesh that CGAL's algorithms take, and what its elements are called on the surface.
struct Oriented_mesh {
  Surface_mesh mesh;
  std::vector<std::uint32_t> vertex_numbers;  ///< per vertex of `mesh`; the first V are those of the surface
  std::vector<std::uint32_t> face_numbers;    ///< per face of `mesh`
  std::vector<bool> turned;                   ///< per face of `mesh`: it faces the other way than on the surface
};

/// A mesh of any surface, also of one that is no manifold.
///
/// Faces are turned where neighbours disagree. Edges of more than two faces and vertices of several fans are cut open:
/// the mesh has a further vertex for each further fan. A face with a corner twice has no place in a mesh and is left
/// out; on the surface its vertices keep their edges.
///
/// Coordinates are scaled by a power of two that brings the largest below 1, and rounded to multiples of 2^-50, so
/// that no product of differences vanishes. Cost O(V + F log F).
Oriented_mesh oriented_mesh(const Numbered_surface& surface);

}  // namespace lodestone
