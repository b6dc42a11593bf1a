// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/aabb.h"

/// Fits an Aabb, built for several instruction sets and chosen at run time. Minima and maxima do not round, so all give
/// the same box.
namespace lodestone::kernel {

/// Fits a box to some vertices.
/// @param vertices  `count` indices, at least one
void fit_box(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Aabb& box);

}  // namespace lodestone::kernel
