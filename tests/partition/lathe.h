// SPDX-License-Identifier: GPL-3.0-or-later
// Closed surfaces of revolution around the x axis.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "support/test_meshes.h"

namespace lodestone {

/// A point of the profile: the distance `radius` from the axis at `x`.
struct Profile_point {
  double x = 0, radius = 0;
};

/// Rings of `around` vertices, ring after ring, then the two poles, which lie at the x of the first and the last ring
/// moved outwards by `cap`.
Surface_mesh lathe(const std::vector<Profile_point>& profile, std::uint32_t around, double cap);

/// Two balls of these radii joined by a bridge of length 2 and the given radius along the x axis, whose middle is the
/// origin.
Surface_mesh dumbbell(double left, double right, double bridge, std::uint32_t around = 24, int parts = 12);

}  // namespace lodestone
