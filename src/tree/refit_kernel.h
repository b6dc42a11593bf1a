// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/aabb.h"
#include "tree/read_ahead.h"

/// The inner loop of a refit, built for several instruction sets and chosen at run time. Minima and maxima do not
/// round, so all give the same boxes.
namespace lodestone::kernel {

struct Refit {
  const double* coordinates;          ///< 3 V
  const std::uint32_t* vertices;      ///< vertex lists of all leaves, one after the other, each ascending, and as many
                                      ///< valid numbers more as `vertices_ahead`
  const std::uint32_t* vertex_begin;  ///< per leaf and past the last: start of its list, which is not empty
  const std::uint32_t* leaf_nodes;    ///< per leaf: its place in `boxes`
  Aabb* boxes;
  bool beyond_cache;  ///< the coordinates are too many to be found in the cache
};

/// What is added up on the way.
struct Refit_sums {
  double coordinates;  ///< not finite if one of them is not, else mostly finite
  double extents;      ///< of the boxes: their sides
};

/// Fits the boxes of the leaves `first` to `end`.
Refit_sums refit_leaves(const Refit& refit, std::size_t first, std::size_t end);

/// Sum of the coordinates of the vertices of one leaf, not finite if one of them is not; `refit.boxes` may be null. It
/// also asks for the vertices of the leaves that follow, if the coordinates are beyond the cache.
double sum_coordinates(const Refit& refit, std::size_t leaf);

}  // namespace lodestone::kernel
