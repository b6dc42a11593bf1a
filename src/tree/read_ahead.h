// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simd/widest_vector.h"

/// How far kernels read past the end of a leaf's lists. The lists of a tree are padded by as much.
namespace lodestone::kernel {

/// Vertices by which a refit prefetches coordinates that do not fit into the cache.
inline constexpr std::size_t vertices_ahead = 64;
/// Faces past the last whose corners are read, as part of a vector, and ignored.
inline constexpr std::size_t faces_ahead = most_box_lanes;

}  // namespace lodestone::kernel
