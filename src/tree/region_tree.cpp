// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/region_tree.h"

#include "tree/refit_kernel.h"

namespace lodestone {

/// A node's box is one cache line: a walk waits once to read it, and a refit writes whole lines.
static_assert(sizeof(Aabb) == 64);

namespace {

/// Above this number of vertices, 12 MB, coordinates are assumed not to fit into a processor's last-level cache.
constexpr std::size_t cached_vertices = 500'000;

kernel::Refit refit_of(const Tree_layout& layout, Coordinates coordinates, Aabb* boxes) {
  return {.coordinates = coordinates.data(),
          .vertices = layout.all_vertices().data(),
          .vertex_begin = layout.vertex_begin().data(),
          .leaf_nodes = layout.leaf_nodes().data(),
          .boxes = boxes,
          .beyond_cache = coordinates.size() / 3 > cached_vertices};
}

}  // namespace

double sum_coordinates(const Tree_layout& layout, Coordinates coordinates, std::size_t leaf) {
  return kernel::sum_coordinates(refit_of(layout, coordinates, nullptr), leaf);
}

Leaf_sums fit_leaves(const Tree_layout& layout, Coordinates coordinates, std::size_t first, std::size_t end,
                     std::span<Aabb> boxes) {
  const auto [sum, extents] = kernel::refit_leaves(refit_of(layout, coordinates, boxes.data()), first, end);
  return {.coordinates = sum, .extents = extents};
}

std::vector<Aabb> fitted_boxes(const Tree_layout& layout, Coordinates coordinates) {
  std::vector<Aabb> boxes(layout.node_count());
  fit_leaves(layout, coordinates, 0, layout.leaf_count(), std::span(boxes));
  for (auto node = static_cast<std::uint32_t>(boxes.size()); node-- > 0;)
    if (!layout.is_leaf(node)) boxes[node].enclose(boxes[node + 1], boxes[layout.node(node).second_child]);
  return boxes;
}

template class Basic_region_tree<Aabb>;

}  // namespace lodestone
