// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/live_positions.h"
#include "lodestone/mesh/vertex_faces.h"
#include "lodestone/mesh/vertex_graph.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// The surface of one object as a particle sees it that may walk anywhere. All of it must outlive this.
struct Walked_surface {
  const Vertex_graph* graph = nullptr;         ///< of `walked`
  const Vertex_faces* vertex_faces = nullptr;  ///< of `walked`
  std::span<const Corners> walked;             ///< F: the faces, with the vertices of closed seams as one
  std::span<const Corners> faces;              ///< F: the faces as they are
  const Live_positions* positions = nullptr;   ///< of the vertices in this frame

  /// Where a vertex is in this frame.
  Eigen::Vector3d position(std::uint32_t vertex) const { return (*positions)(vertex); }
};

/// A face with the positions of its corners.
struct Read_face {
  std::uint32_t face = 0;  ///< its index
  Triangle triangle;       ///< its corners
  Box box;                 ///< around them
};

/// Reads the corners of a face.
/// @throws Bad_mesh  a coordinate is not finite
Read_face read_face(const Walked_surface& surface, std::uint32_t face);

}  // namespace lodestone
