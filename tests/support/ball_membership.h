// SPDX-License-Identifier: GPL-3.0-or-later
// Which points are in volumes bounded by spheres, decided exactly.
#pragma once

#include <cmath>

#include "lodestone/volumes/bounding_sphere.h"
#include "lodestone/volumes/spherical_shell.h"
#include "support/exact_point.h"

namespace lodestone {

bool inside(const Bounding_sphere& ball, const Exact_point& p);

bool inside(const Spherical_shell& shell, const Exact_point& p);

}  // namespace lodestone
