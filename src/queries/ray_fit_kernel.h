// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/queries/ray_node.h"
#include "queries/relative_place.h"

/// The pass over all faces of a Ray_tree, built for several instruction sets and chosen at run time. All give the same
/// bits.
namespace lodestone::kernel {

/// Writes the corners of blocks, whose vertices are known.
/// @param coordinates  of all vertices
/// @param boxes        one per block, overwritten
void fit_blocks(const double* coordinates, const Relative_place& place, std::span<Ray_block> blocks, Ray_box* boxes);

}  // namespace lodestone::kernel
