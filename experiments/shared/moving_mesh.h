// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// View of a mesh whose faces stay and whose positions change from frame to frame. Valid as long as the mesh and the
/// corners.
struct Moving_mesh {
  const Surface_mesh* mesh = nullptr;
  std::span<const Corners> corners;  ///< per face

  std::span<const Point> points() const { return {mesh->points().data(), mesh->number_of_vertices()}; }
  /// Three per vertex.
  std::span<const double> coordinates() const {
    static_assert(sizeof(Point) == 3 * sizeof(double));
    return {reinterpret_cast<const double*>(points().data()), 3 * points().size()};
  }
};

}  // namespace lodestone
