// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simd/widest_vector.h"

/// How far past the end of a leaf's lists kernels read; a tree's lists have this much padding.
namespace lodestone::kernel {

/// Vertices by which a refit prefetches coordinates that do not fit into the cache.
inline constexpr std::size_t vertices_ahead = 64;
/// Faces in the widest vector that corners are read in.
inline constexpr std::size_t faces_ahead = most_side_lanes;

}  // namespace lodestone::kernel
