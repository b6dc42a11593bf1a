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

/// Volume of the intersection of slabs, up to rounding; infinite if a side of the box is. O(n^3) for n slabs.
/// @param slabs  with distinct directions; those of the box are among them
/// @param box    around the intersection
double polytope_volume(std::span<const Slab> slabs, const Aabb& box);

}  // namespace lodestone
