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
  const std::uint32_t* vertices;      ///< vertex lists of all leaves, one after the other, each ascending, padded with
                                      ///< `vertices_ahead` valid indices
  const std::uint32_t* vertex_begin;  ///< per leaf and past the last: start of its list, which is not empty
  const std::uint32_t* leaf_nodes;    ///< per leaf: its index in `boxes`
  Aabb* boxes;
  bool beyond_cache;  ///< the coordinates do not fit into the cache
};

/// Sums over the leaves of a refit.
struct Refit_sums {
  double coordinates;  ///< of the vertices. Non-finite if any input is; may also overflow
  double extents;      ///< of the boxes: the sums of their sides
};

/// Fits the boxes of the leaves in [first, end).
Refit_sums refit_leaves(const Refit& refit, std::size_t first, std::size_t end);

/// Sum of the coordinates of a leaf's vertices. Non-finite if any input is; may also overflow. Prefetches the vertices
/// of the leaves that follow if the coordinates do not fit into the cache. `refit.boxes` may be null.
double sum_coordinates(const Refit& refit, std::size_t leaf);

}  // namespace lodestone::kernel
