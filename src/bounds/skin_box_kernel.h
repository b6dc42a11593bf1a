// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lodestone/bounds/joint_range.h"
#include "lodestone/bounds/morph_shift.h"
#include "lodestone/volumes/aabb.h"

/// The box of a Skin_bound, built for several instruction sets and chosen at run time. All give the same bits.
namespace lodestone::kernel {

/// One node, and where its joints are.
struct Skinned_node {
  const Joint_range* ranges;    ///< of its joints
  std::size_t joint_count;      ///< of the node; >= 1
  std::size_t most_influences;  ///< on one vertex
  const double* columns;        ///< per joint of the skin: the columns of its motion, each padded to four numbers
  Morph_shift shift;            ///< what morphing adds to the boxes at rest
};

/// One joint of the node: the box at rest, widened by what morphing adds, and where the joint takes its ends.
struct Moved_range {
  double centre[4], half[4];
  double reach[4];  ///< the greatest absolute coordinates
  double low[4];    ///< the least coordinate, negated
  double high[4];   ///< the greatest coordinate
};

/// The box around the vertices of a node. Along an axis on which it is not finite, it is not bounded.
/// @param moved  memory for `joint_count` elements
Aabb skin_box(const Skinned_node& node, Moved_range* moved);

}  // namespace lodestone::kernel
