// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// A surface as a mesh that CGAL's algorithms accept, with the indices of its elements on the surface.
struct Oriented_mesh {
  Surface_mesh mesh;                          ///< a manifold, its faces oriented alike where they can be
  std::vector<std::uint32_t> vertex_indices;  ///< per vertex of `mesh`; the first V are those of the surface in order
  std::vector<std::uint32_t> face_indices;    ///< per face of `mesh`
  std::vector<bool> turned;  ///< per face of `mesh`: its orientation is opposite to that on the surface
};

/// Makes a mesh of any surface, even of one that is not a manifold.
///
/// Faces are turned where neighbours disagree in orientation. Edges of more than two faces and vertices of several fans
/// are cut open: the mesh has an additional vertex for each additional fan. A mesh cannot have a face that uses a
/// vertex twice. Such faces are left out, but on the surface their vertices keep their edges.
///
/// Coordinates are scaled by a power of two that brings the largest below 1, and rounded to multiples of 2^-50, so that
/// no product of differences underflows. Cost O(V + F log F).
Oriented_mesh oriented_mesh(const Numbered_surface& surface);

}  // namespace lodestone
