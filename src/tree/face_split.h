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

/// Centres that are spread less than this, in [-1, 1], share a few thousand floats: they could hardly be told apart.
constexpr float narrow_spread = 0x1p-11F;

/// How far the centres are spread along the axis on which they are spread widest. O(n).
/// @param items  at least one
float widest_spread(std::span<const Split_item> items);

/// Where `split_items` has left the items.
enum class Split_result {
  in_place,
  in_spare,   ///< the other holds rubbish
  too_narrow  ///< where they were, as they were
};

/// Distributes items along the axis on which their centres are spread widest: afterwards none of the first
/// `first_count` lies behind one of the others. Of equal ones, those of lower index come first. O(n).
/// @param items    at least one
/// @param spare    as many
/// @param least    if the centres are spread less than this, nothing is done; 0: they are distributed anyway
/// @param workers  share the work if there are many items; the result does not depend on how many they are
Split_result split_items(std::span<Split_item> items, std::span<Split_item> spare, std::size_t first_count,
                         float least = 0, Workers& workers = Workers::alone());

}  // namespace lodestone
