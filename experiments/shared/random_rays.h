// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/queries/ray_search.h"

namespace lodestone {

/// Random rays around the unit sphere, always the same, with origins and directions that float represents, so that all
/// libraries get the same ones. Every other origin is in the cube of two, the rest in that of a half.
std::vector<Ray> random_rays(std::size_t count);

/// Where they begin.
std::vector<Point> random_ray_origins(std::size_t count);

}  // namespace lodestone
