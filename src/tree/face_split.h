// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lodestone/mesh/workers.h"

namespace lodestone {

/// What a split distributes: a face with the mean of its corners, or a region with the mean of its faces' centres.
struct Split_item {
  std::array<float, 3> centre;
  std::uint32_t index;
};

/// Distributes items along the axis on which their centres are spread widest: afterwards none of the first
/// `first_count` lies behind one of the others. Of equal ones, those of lower index come first. O(n).
/// @param items  at least one
/// @param spare  as many
/// @param workers  share the work if there are many items; the result does not depend on how many they are
/// @return whether the items are in `spare` now; the other holds rubbish
bool split_items(std::span<Split_item> items, std::span<Split_item> spare, std::size_t first_count,
                 Workers& workers = Workers::alone());

}  // namespace lodestone
