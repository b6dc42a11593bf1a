// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

#include "lodestone/tree/tree_layout.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Boxes around the vertices of each node of a tree in the current pose, from the parameters of the motion alone: no
/// position is computed.
///
/// `bound.box(node)` contains the position of every vertex of the node as it *would be computed*, rounding included. It
/// may be infinite where numbers overflow. Several threads may ask at once while the pose stays as it is.
template <class B>
concept Motion_bound = requires(const B& bound, std::uint32_t node) {
  { bound.node_count() } -> std::convertible_to<std::size_t>;
  { bound.box(node) } -> std::same_as<Aabb>;
};

/// @throws Bad_argument  a leaf of the layout lists a vertex that does not exist
void check_layout(const Tree_layout& layout, std::size_t vertex_count);

/// What two boxes have in common, where both contain the same points. O(1).
inline Aabb common_box(const Aabb& a, const Aabb& b) {
  Aabb box{};
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = a.low[axis] > b.low[axis] ? a.low[axis] : b.low[axis];
    box.high[axis] = a.high[axis] < b.high[axis] ? a.high[axis] : b.high[axis];
  }
  return box;
}

}  // namespace lodestone
