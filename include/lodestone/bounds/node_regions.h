// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Stands for the region of vertices that belong to more than one.
inline constexpr Region_index several_regions = std::numeric_limits<Region_index>::max();

/// Per node: the region that all its vertices belong to, or `several_regions`. O(V).
/// @param labels  V: region of each vertex; empty: all vertices are in region 0
std::vector<Region_index> node_regions(const Tree_layout& layout, std::span<const Region_index> labels);

}  // namespace lodestone
