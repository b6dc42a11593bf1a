// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lodestone/contact/crossing.h"

namespace lodestone {

/// Coordinates of all vertices in one frame, by vertex number: x, y, z, x, y, z, ...; 3 V values.
using Coordinates = std::span<const double>;

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

/// Two faces by their places in the lists of their leaves.
struct Face_places {
  std::uint8_t a = 0;
  std::uint8_t b = 0;
  Crossing crossing = no_crossing;
  std::uint8_t unused = 0;  ///< so that a vector can write several
};

}  // namespace lodestone
