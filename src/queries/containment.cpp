// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/containment.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <limits>
#include <span>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/queries/surface_on_demand.h"
#include "lodestone/triangles/ray_crossing.h"
#include "mesh/is_finite.h"
#include "queries/ray_leaf_kernel.h"
#include "triangles/ray_depth.h"

namespace lodestone {

namespace {

bool contains(const Triangle& t, const Point& point) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    if (point[axis] < low || point[axis] > high) return false;
  }
  return triangles_intersect(t, {point, point, point});
}

Point upside_down(const Point& p) { return {p.x(), p.y(), -p.z()}; }

/// Counts the faces that a ray from a point crosses, leaf by leaf. The ray goes along z, up or down: to the side of the
/// box around the surface that is nearer.
template <Surface_on_demand Surface>
class Vertical_ray {
 public:
  Vertical_ray(Surface& surface, const Point& point)
      : surface_(surface),
        point_(point),
        upward_(is_upward(surface.box(0))),
        input_{
            .origin = {point.x(), point.y(), point.z()}, .shear = {}, .sign = upward_ ? 1.0 : -1.0, .depth_axis = 2} {}

  /// @return of no meaning once the surface is broken
  Point_side run() {
    const Tree_layout& tree = surface_.layout();
    stack_.assign(1, 0);
    while (!stack_.empty() && !surface_.is_broken()) {
      const std::uint32_t n = stack_.back();
      stack_.pop_back();
      if (!meets(surface_.box(n))) continue;
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
    const Aabb& box = surface_.pose(index);
    if (!meets(box)) return false;
    const Leaf_faces leaf = surface_.view().leaf(index);
    std::uint8_t candidates[most_leaf_faces];
    const double error = frame_error(kernel::reach(box, input_.origin));
    const std::size_t count =
        kernel::list_ray_candidates(leaf, input_, error, std::numeric_limits<double>::infinity(), candidates);
    for (const std::uint8_t face : std::span(candidates, count)) {
      const Triangle t = triangle_of(leaf_triangle(leaf, face));
      if (contains(t, point_)) return true;
      inside_ ^= crosses(t);
    }
    return false;
  }

  bool is_upward(const Aabb& around) const { return around.high[2] - point_.z() <= point_.z() - around.low[2]; }
  bool meets(const Aabb& box) const {
    return box.low[0] <= point_.x() && point_.x() <= box.high[0] && box.low[1] <= point_.y() &&
           point_.y() <= box.high[1] && (upward_ ? point_.z() <= box.high[2] : box.low[2] <= point_.z());
  }
  bool crosses(const Triangle& t) const {
    if (upward_) return crosses_upward_ray(t, point_);
    return crosses_upward_ray({upside_down(t[0]), upside_down(t[1]), upside_down(t[2])}, upside_down(point_));
  }

  Surface& surface_;
  const Point& point_;
  const bool upward_;
  const kernel::Ray_input input_;
  bool inside_ = false;
  boost::container::small_vector<std::uint32_t, 64> stack_;
};

template <Surface_on_demand Surface>
Point_side find_side(Surface& surface, const Point& point) {
  if (!is_finite(point)) throw Bad_argument("the point has a coordinate that is not finite");
  return ask_until_settled([&] { return Vertical_ray(surface, point).run(); }, surface);
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
  if (!contains(outer_layout.boxes.front(), inner_layout.boxes.front()) || !outer.closed()) return false;
  return std::ranges::all_of(inner.component_vertices(), [&](std::uint32_t vertex) {
    const double* p = inner.coordinates().data() + 3 * std::size_t{vertex};
    return encloses(outer_layout, Point(p[0], p[1], p[2]));
  });
}

bool encloses(Bounded_surface& outer, Bounded_surface& inner) {
  const auto inside = [&](const Leaf_vertex& at) {
    const Eigen::Vector3d p = inner.position(at);
    const Point point(p.x(), p.y(), p.z());
    return Vertical_ray(outer, point).run() == Point_side::inside;
  };
  return ask_until_settled(
      [&] {
        // Boxes can be loose, so one within the other would prove nothing, and neither would the opposite.
        if (!near(outer.box(0), inner.box(0), 0) || !outer.tree().closed()) return false;
        return std::ranges::all_of(inner.component_vertices(), inside);
      },
      outer, inner);
}

}  // namespace lodestone
