// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lodestone/mesh/coordinates.h"

namespace lodestone {

/// A leaf of a region tree has at most so many faces, and so at most three times as many vertices.
inline constexpr std::size_t most_leaf_faces = 128;

/// The corners of a face as places in the vertex list of its leaf.
using Leaf_corners = std::array<std::uint16_t, 3>;

/// The faces of a leaf, where they are in one frame: what a bounding volume is fitted to.
struct Leaf_faces {
  Coordinates coordinates;                  ///< of the whole mesh
  std::span<const std::uint32_t> vertices;  ///< numbers of those that the faces have, at least one, ascending
  std::span<const Leaf_corners> corners;    ///< per face

  /// x, y and z of the vertex at a place in `vertices`.
  const double* position(std::size_t place) const { return coordinates.data() + 3 * std::size_t{vertices[place]}; }
};

}  // namespace lodestone
