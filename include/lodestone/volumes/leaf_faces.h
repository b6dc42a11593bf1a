// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lodestone/mesh/coordinates.h"

namespace lodestone {

/// Maximum number of faces in a leaf of a region tree. A leaf has at most three times as many vertices.
inline constexpr std::size_t most_leaf_faces = 128;

/// The corners of a face, as indices into the vertex list of its leaf.
using Leaf_corners = std::array<std::uint16_t, 3>;

/// The faces of a leaf with their positions in one frame: the input for fitting a bounding volume.
struct Leaf_faces {
  Coordinates coordinates;                  ///< of the whole mesh
  std::span<const std::uint32_t> vertices;  ///< indices of the faces' vertices; at least one, ascending
  std::span<const Leaf_corners> corners;    ///< per face

  /// x, y and z of vertex `vertices[index]`.
  const double* position(std::size_t index) const { return coordinates.data() + 3 * std::size_t{vertices[index]}; }
};

}  // namespace lodestone
