// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simd/widest_vector.h"

/// How far past the end of a leaf's lists kernels read; a tree's lists are padded by as much.
namespace lodestone::kernel {

/// Vertices that a refit of coordinates beyond the cache prefetches.
inline constexpr std::size_t vertices_ahead = 64;
/// Faces whose corners are read in vectors, whatever they are.
inline constexpr std::size_t faces_ahead = most_box_lanes;

}  // namespace lodestone::kernel
