// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/containment.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/queries/surface_on_demand.h"
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

bool contains(const Triangle& t, const Point& point) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    if (point[axis] < low || point[axis] > high) return false;
  }
  return triangles_intersect(t, {point, point, point});
}

/// Counts the faces that the ray from a point along +z crosses, leaf by leaf.
template <Surface_on_demand Surface>
class Upward_ray {
 public:
  Upward_ray(Surface& surface, const Point& point) : surface_(surface), point_(point) {}

  /// @return of no meaning once the surface is broken
  Point_side run() {
    const Tree_layout& tree = surface_.layout();
    stack_.assign(1, 0);
    while (!stack_.empty() && !surface_.is_broken()) {
      const std::uint32_t n = stack_.back();
      stack_.pop_back();
      if (!meets_ray(surface_.box(n), point_)) continue;
      if (!tree.is_leaf(n)) {
        stack_.push_back(tree.node(n).second_child);
        stack_.push_back(n + 1);
      } else if (is_on_leaf(tree.node(n).leaf)) {
        return Point_side::on_surface;
      }
    }
    return inside_ ? Point_side::inside : Point_side::outside;
  }

 private:
  bool is_on_leaf(std::uint32_t index) {
    if (!meets_ray(surface_.pose(index), point_)) return false;
    const Leaf_faces leaf = surface_.view().leaf(index);
    for (std::size_t face = 0; face < leaf.corners.size(); ++face) {
      const Triangle t = triangle_of(leaf_triangle(leaf, face));
      if (contains(t, point_)) return true;
      inside_ ^= crosses_upward_ray(t, point_);
    }
    return false;
  }

  Surface& surface_;
  const Point& point_;
  bool inside_ = false;
  std::vector<std::uint32_t> stack_;
};

template <Surface_on_demand Surface>
Point_side find_side(Surface& surface, const Point& point) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(point[axis])) throw Bad_argument("the point has a coordinate that is not finite");
  return ask_until_settled([&] { return Upward_ray(surface, point).run(); }, surface);
}

Point position_of(const Bounded_surface& surface, std::uint32_t vertex) {
  const Eigen::Vector3d p = surface.positions()(vertex);
  if (!p.allFinite()) throw Bad_mesh("vertex " + std::to_string(vertex) + " has a coordinate that is not finite");
  return {p.x(), p.y(), p.z()};
}

}  // namespace

Point_side point_side(const Layout_view& surface, const Point& point) {
  Fitted_surface fitted(surface);
  return find_side(fitted, point);
}

Point_side point_side(Bounded_surface& surface, const Point& point) { return find_side(surface, point); }

bool encloses(const Layout_view& surface, const Point& point) {
  return point_side(surface, point) == Point_side::inside;
}

bool encloses(const Object_surface& outer, const Layout_view& outer_layout, const Object_surface& inner,
              const Layout_view& inner_layout) {
  if (!box_within(inner_layout.boxes.front(), outer_layout.boxes.front()) || !outer.closed()) return false;
  return std::ranges::all_of(inner.piece_vertices(), [&](std::uint32_t vertex) {
    const double* p = inner.coordinates().data() + 3 * std::size_t{vertex};
    return encloses(outer_layout, Point(p[0], p[1], p[2]));
  });
}

bool encloses(Bounded_surface& outer, Bounded_surface& inner) {
  const auto inside = [&](std::uint32_t vertex) {
    const Point point = position_of(inner, vertex);
    return Upward_ray(outer, point).run() == Point_side::inside;
  };
  return ask_until_settled(
      [&] {
        // Boxes can be loose, so one within the other would prove nothing, and neither would the opposite.
        if (!near(outer.box(0), inner.box(0), 0) || !outer.tree().closed()) return false;
        return std::ranges::all_of(inner.tree().piece_vertices(), inside);
      },
      outer, inner);
}

}  // namespace lodestone
