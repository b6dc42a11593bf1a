// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// The points p with low <= direction . p <= high.
struct Slab {
  double direction[3];
  double low;
  double high;
};

/// Volume of the points that are in all slabs, up to rounding; infinite if a side of the box is. O(n^3) for n slabs.
/// @param slabs  of which no two have one direction; among them those of the box
/// @param box    around them
double polytope_volume(std::span<const Slab> slabs, const Aabb& box);

}  // namespace lodestone
