// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/point_search.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/queries/surface_on_demand.h"
#include "lodestone/triangles/triangle_distance.h"
#include "mesh/is_finite.h"
#include "queries/point_leaf_kernel.h"
#include "triangles/point_distance.h"

namespace lodestone {

namespace {

/// A face, and how far it is from the query.
struct Near_face {
  std::uint32_t face;
  Triangle triangle;
  Distance_estimate distance;
  std::optional<Exact_squared> exact = {};

  const Exact_squared& exact_distance_from(const Point& query) {
    if (!exact) exact = exact_squared_distance(query, triangle);
    return *exact;
  }
};

/// By distance, then by index. Exact numbers are needed only where the bounds overlap and the faces do not share what
/// is nearest.
bool is_nearer(const Point& query, Near_face& a, Near_face& b) {
  if (a.distance.high < b.distance.low) return true;
  if (b.distance.high < a.distance.low) return false;
  if (a.distance.part.is_known() && a.distance.part == b.distance.part) return a.face < b.face;
  const auto order = CGAL::compare(a.exact_distance_from(query), b.exact_distance_from(query));
  return order != CGAL::EQUAL ? order == CGAL::SMALLER : a.face < b.face;
}

Closest_point rounded(const Query_point& query, const Near_face& nearest) {
  const auto& distance = nearest.distance;
  const auto& weights = distance.weights;
  const Triangle& t = nearest.triangle;
  if (distance.high == 0) return {nearest.face, query.point, 0};
  if (distance.high - distance.low <= 0x1p-31 * distance.low) {
    const auto mean = [&](int axis) {
      return (1 - weights[0] - weights[1]) * t[0][axis] + weights[0] * t[1][axis] + weights[1] * t[2][axis];
    };
    // Not 0, though it may be nearer to that than to any other double. Processors compare slowly with the least double.
    const double rounded = std::sqrt(distance.squared) / query.scale;
    return {nearest.face, Point(mean(0), mean(1), mean(2)),
            rounded > 0 ? rounded : std::numeric_limits<double>::denorm_min()};
  }
  const auto points = closest_points(t, {query.point, query.point, query.point});
  return {nearest.face, points.a, points.distance};
}

/// Distances in here are squared and scaled.
template <Surface_on_demand Surface>
class Point_search {
 public:
  Point_search(Surface& surface, const Point& point)
      : surface_(surface), query_(point, surface.box(0).low, surface.box(0).high), input_{{}, query_.scale} {
    for (int axis = 0; axis < 3; ++axis) input_.scaled[axis] = point[axis] * query_.scale;
  }

  /// @return none if the surface is broken
  std::optional<Closest_point> run() {
    const Tree_layout& tree = surface_.layout();
    waiting_.push_back({0, bound(surface_.box(0))});
    while (!waiting_.empty()) {
      const Node_near next = waiting_.back();
      waiting_.pop_back();
      if (next.distance > most_) continue;
      if (!tree.is_leaf(next.node)) {
        open(next.node + 1, tree.node(next.node).second_child);
        continue;
      }
      compare(tree.node(next.node).leaf);
      if (surface_.is_broken()) return std::nullopt;
    }
    return rounded(query_, *best_);
  }

 private:
  /// A node, and a lower bound on its distance.
  struct Node_near {
    std::uint32_t node;
    double distance;
  };

  [[gnu::always_inline]] double bound(const Aabb& box) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = input_.scaled[axis];
      const double gap = std::max({box.low[axis] * query_.scale - at, at - box.high[axis] * query_.scale, 0.0});
      sum += gap * gap;
    }
    return std::max(sum * (1 - kernel::distance_roundings) - kernel::distance_underflow, 0.0);
  }

  /// The nearer child is pushed last.
  void open(std::uint32_t first, std::uint32_t second) {
    Node_near near{first, bound(surface_.box(first))}, far{second, bound(surface_.box(second))};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance <= most_) waiting_.push_back(far);
    if (near.distance <= most_) waiting_.push_back(near);
  }

  void compare(std::uint32_t index) {
    const Aabb& box = surface_.pose(index);
    if (surface_.is_broken() || bound(box) > most_) return;
    const Leaf_faces leaf = surface_.view().leaf(index);
    std::uint8_t candidates[most_leaf_faces];
    const std::size_t count = kernel::list_near_faces(leaf, input_, most_, candidates);
    for (std::size_t i = 0; i < count; ++i) offer(leaf, candidates[i], surface_.layout().faces(index)[candidates[i]]);
  }

  void offer(const Leaf_faces& leaf, std::size_t index, std::uint32_t face) {
    const Triangle_corners corners = leaf_triangle(leaf, index);
    const auto [p, q, r] = leaf.corners[index];
    Near_face next{
        face, {}, estimate_distance(query_, corners, {leaf.vertices[p], leaf.vertices[q], leaf.vertices[r]})};
    if (next.distance.low > most_) return;
    next.triangle = triangle_of(corners);
    if (best_ && !is_nearer(query_.point, next, *best_)) return;
    most_ = std::min(most_, next.distance.high);
    best_ = std::move(next);
  }

  Surface& surface_;
  Query_point query_;
  kernel::Point_input input_;
  double most_ = std::numeric_limits<double>::infinity();  ///< upper bound on the distance of the nearest face
  std::optional<Near_face> best_;
  boost::container::small_vector<Node_near, 64> waiting_;
};

template <Surface_on_demand Surface>
Closest_point find_closest_point(Surface& surface, const Point& point) {
  if (!is_finite(point)) throw Bad_argument("the point has a coordinate that is not finite");
  return *ask_until_settled([&] { return Point_search(surface, point).run(); }, surface);
}

}  // namespace

Closest_point closest_point(const Layout_view& surface, const Point& point) {
  Fitted_surface fitted(surface);
  return find_closest_point(fitted, point);
}

Closest_point closest_point(Bounded_surface& surface, const Point& point) { return find_closest_point(surface, point); }

}  // namespace lodestone
