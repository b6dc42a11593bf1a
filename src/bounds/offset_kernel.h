// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/bounds/morph_shift.h"
#include "lodestone/bounds/offset_range.h"

/// The sums of Morph_shifts, built for several instruction sets and chosen at run time. All give the same bits.
namespace lodestone::kernel {

/// Adds up what the targets of a node do to its vertices, in order. Targets of weight 0 are left out.
/// @param ranges   of the node, by target
/// @param weights  per target of the mesh
Morph_shift add_offsets(std::span<const Offset_range> ranges, const double* weights);

}  // namespace lodestone::kernel
