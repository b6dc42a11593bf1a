// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lodestone/tree/tree_layout.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Boxes around the vertices of each node of a tree in the current pose, found without computing their positions, or
/// with a few of them.
///
/// `bound.box(node)` contains every vertex of the node where it *would be computed* to be, rounding included. It is
/// infinite where numbers overflow. Several threads may ask at once while the pose stays as it is.
template <class B>
concept Motion_bound = requires(const B& bound, std::uint32_t node) {
  { bound.node_count() } -> std::convertible_to<std::size_t>;
  { bound.box(node) } -> std::same_as<Aabb>;
};

/// A bound that reads some positions to find a box.
///
/// `bound.box(node, read)` gives the same box, and appends to `read` the positions that it has read of the node's own
/// vertices, so that they are compared with the boxes of other bounds. What `read` holds already stays.
template <class B>
concept Reading_bound =
    Motion_bound<B> && requires(const B& bound, std::uint32_t node, std::vector<Eigen::Vector3d>& read) {
      { bound.box(node, read) } -> std::same_as<Aabb>;
    };

/// A bound that learns from positions which have been computed, or compares them with what was promised.
///
/// `bound.note_read(leaf, fitted, coordinates)` is called once in a frame for a leaf that has been read, with the box
/// fitted to it, and 3 V coordinates of which those of the leaf are current. It returns whether they keep the promise.
template <class B>
concept Watching_bound =
    Motion_bound<B> && requires(B& bound, std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) {
      { bound.note_read(leaf, fitted, coordinates) } -> std::same_as<bool>;
    };

/// A bound that need not be shown leaf by leaf what is read as a whole.
///
/// `bound.note_all(fitted, coordinates, all)` is called in place of `note_read` for the leaves when all vertices have
/// been read, with the boxes fitted to all nodes. Unless `all` is set, it may compare less with the promise: answers
/// rely on nothing then but on boxes, and those are compared with the fitted ones.
template <class B>
concept All_watching_bound =
    Watching_bound<B> && requires(B& bound, std::span<const Aabb> fitted, Coordinates coordinates, bool all) {
      { bound.note_all(fitted, coordinates, all) } -> std::same_as<bool>;
    };

/// Opens the axis of a box that has overflowed: it says nothing then. O(1).
inline void open_if_not_finite(Aabb& box, std::size_t axis) {
  if (std::isfinite(box.low[axis]) && std::isfinite(box.high[axis])) return;
  box.low[axis] = -std::numeric_limits<double>::infinity();
  box.high[axis] = std::numeric_limits<double>::infinity();
}

/// Checks that a layout lists no vertex that does not exist. O(V).
/// @throws Bad_argument  it does
void check_layout(const Tree_layout& layout, std::size_t vertex_count);

/// Whether a position lies in a box. O(1).
inline bool contains(const Aabb& box, const Eigen::Vector3d& position) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.low[axis] <= position[axis] && position[axis] <= box.high[axis])) return false;
  return true;
}

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
