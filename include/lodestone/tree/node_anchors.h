// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// A vertex of a node of a tree, by whose position the node is judged without reading the others.
struct Node_anchor {
  std::uint32_t vertex = 0;  ///< of the node's vertices the one nearest to the centre of their box
  double radius = 0;         ///< rho: from there to the farthest of the node's vertices at rest, and by 10^-9 longer
};

/// The anchor of each node. O(V), and below each node the few leaves that its children's anchors leave open.
/// @param coordinates  3 V, all finite: where the vertices are at rest
std::vector<Node_anchor> find_anchors(const Tree_layout& layout, Coordinates coordinates);

}  // namespace lodestone
