// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// What a Ray_tree is made of. Coordinates are relative to the box around the surface, and at most 1 in size.
namespace lodestone {

/// Most children of a node, and faces of a block.
inline constexpr std::size_t ray_tree_width = 8;

/// A box.
struct Ray_box {
  std::array<float, 3> low;   ///< lower corner
  std::array<float, 3> high;  ///< upper corner
};

/// Some faces that are near each other. Beyond `count` the corners are where no ray comes to, and the last vertices and
/// face are repeated.
struct alignas(64) Ray_block {
  float corners[3][3][ray_tree_width];        ///< x, y and z of each corner
  std::uint32_t vertices[3][ray_tree_width];  ///< indices of the corners
  std::uint32_t faces[ray_tree_width];        ///< indices
  std::uint32_t count;                        ///< 1 .. ray_tree_width
};

/// The boxes of some children. Boxes beyond the last child are empty.
struct alignas(64) Ray_node {
  float sides[2][3][ray_tree_width];       ///< x, y and z of the lower corners, then of the upper ones
  std::uint32_t children[ray_tree_width];  ///< indices of nodes, or of blocks with `is_ray_block` added
};

/// Marks a child.
inline constexpr std::uint32_t is_ray_block = std::uint32_t{1} << 31;

}  // namespace lodestone
