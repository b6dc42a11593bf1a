// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/containment.h"

#include <algorithm>

#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/triangles/ray_crossing.h"

namespace lodestone {

namespace {

/// Whether the ray from the point along +z meets the box.
bool meets_ray(const Aabb& box, const Point& point) {
  return box.low[0] <= point.x() && point.x() <= box.high[0] && box.low[1] <= point.y() && point.y() <= box.high[1] &&
         point.z() <= box.high[2];
}

bool box_within(const Aabb& inner, const Aabb& outer) {
  return std::equal(outer.low, outer.low + 3, inner.low, std::less_equal()) &&
         std::equal(inner.high, inner.high + 3, outer.high, std::less_equal());
}

}  // namespace

bool encloses(const Layout_view& surface, const Point& point) {
  const Tree_layout& tree = *surface.layout;
  bool inside = false;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t n = stack.back();
    stack.pop_back();
    if (!meets_ray(surface.boxes[n], point)) continue;
    if (!tree.is_leaf(n)) {
      stack.push_back(tree.node(n).second_child);
      stack.push_back(n + 1);
      continue;
    }
    const Leaf_faces leaf = surface.leaf(tree.node(n).leaf);
    for (std::size_t index = 0; index < leaf.corners.size(); ++index)
      inside ^= crosses_upward_ray(triangle_of(leaf_triangle(leaf, index)), point);
  }
  return inside;
}

bool encloses(const Object_surface& outer, const Layout_view& outer_layout, const Object_surface& inner,
              const Layout_view& inner_layout) {
  if (!box_within(inner_layout.boxes.front(), outer_layout.boxes.front()) || !outer.closed()) return false;
  return std::ranges::all_of(inner.piece_vertices(), [&](std::uint32_t vertex) {
    const double* p = inner.coordinates().data() + 3 * std::size_t{vertex};
    return encloses(outer_layout, Point(p[0], p[1], p[2]));
  });
}

}  // namespace lodestone
