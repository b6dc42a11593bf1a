// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/region_tree.h"

#include "contact/refit_kernel.h"

namespace lodestone {

namespace {

/// Vertices whose coordinates, 12 MB, share a processor's last cache with little else.
constexpr std::size_t cached_vertices = 500'000;

}  // namespace

Leaf_sums fit_leaves(const Tree_layout& layout, Coordinates coordinates, std::size_t first, std::size_t end,
                     std::span<Aabb> boxes) {
  const kernel::Refit refit{.coordinates = coordinates.data(),
                            .vertices = layout.all_vertices().data(),
                            .vertex_begin = layout.vertex_begin().data(),
                            .leaf_nodes = layout.leaf_nodes().data(),
                            .boxes = boxes.data(),
                            .beyond_cache = coordinates.size() / 3 > cached_vertices};
  const auto [sum, extents] = kernel::refit_leaves(refit, first, end);
  return {.coordinates = sum, .extents = extents};
}

template class Basic_region_tree<Aabb>;

}  // namespace lodestone
