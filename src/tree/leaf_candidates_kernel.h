// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/tree/leaf_candidates.h"
#include "lodestone/volumes/aabb.h"

/// Compares the boxes of some leaves of two trees, all with all. Built for several instruction sets and chosen at run
/// time.
namespace lodestone::kernel {

/// The leaves below a node.
struct Leaf_bunch {
  const Aabb* boxes;           ///< of all nodes
  const Aabb* around;          ///< the box of this node
  const std::uint32_t* nodes;  ///< of the leaves
  std::uint32_t count;         ///< 1 .. bunch_leaves
};

/// Sets all of `candidates` but `first_a` and `first_b`.
void list_leaf_candidates(const Leaf_bunch& a, const Leaf_bunch& b, double margin, Leaf_candidates& candidates);

}  // namespace lodestone::kernel
