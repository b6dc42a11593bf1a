// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/triangle_intersection.h"

#include <CGAL/Intersections_3/Segment_3_Segment_3.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "triangles/crossing_segment.h"
#include "triangles/exact_crossing.h"
#include "triangles/orientation.h"
#include "triangles/shared_corners.h"

namespace lodestone {

namespace {

/// Tries to prove in floating point that three points are not collinear; `false` proves nothing. The error of each
/// component of the cross product is below 8 roundings of the sum of the magnitudes of its two products.
bool surely_not_collinear(const Triangle& t) {
  constexpr double bound = 1e-14;
  const double ux = t[1].x() - t[0].x(), uy = t[1].y() - t[0].y(), uz = t[1].z() - t[0].z();
  const double vx = t[2].x() - t[0].x(), vy = t[2].y() - t[0].y(), vz = t[2].z() - t[0].z();
  const auto away_from_zero = [](double p, double q) {
    // The relative error of a subnormal product is not small.
    constexpr double normal = 1e-290;
    const double size = std::abs(p) + std::abs(q);
    return size > normal && std::abs(p - q) > bound * size;
  };
  return away_from_zero(uy * vz, uz * vy) || away_from_zero(uz * vx, ux * vz) || away_from_zero(ux * vy, uy * vx);
}

/// A triangle as the set of points it is.
template <class K>
using Shape = std::variant<typename K::Triangle_3, typename K::Segment_3, typename K::Point_3>;

template <class K>
Shape<K> shape(const typename K::Point_3& a, const typename K::Point_3& b, const typename K::Point_3& c) {
  if (!CGAL::collinear(a, b, c)) return typename K::Triangle_3(a, b, c);
  if (a == b && b == c) return a;
  // The two corners with the third between them; `collinear_are_ordered_along_line` counts equal points as ordered.
  if (CGAL::collinear_are_ordered_along_line(a, b, c)) return typename K::Segment_3(a, c);
  if (CGAL::collinear_are_ordered_along_line(b, a, c)) return typename K::Segment_3(b, c);
  return typename K::Segment_3(a, b);
}

/// CGAL's `do_intersect`, with an equality test for two points.
struct Shapes_intersect {
  bool operator()(const Point& a, const Point& b) const { return a == b; }
  template <class A, class B>
  bool operator()(const A& a, const B& b) const {
    return CGAL::do_intersect(a, b);
  }
};

struct Collect_points {
  Intersection_points& points;

  void operator()(const Rational_kernel::Point_3& p) const { points.push_back(nearest_point(p)); }
  void operator()(const Rational_kernel::Segment_3& s) const {
    for (const auto& end : {s.source(), s.target()}) points.push_back(nearest_point(end));
  }
  void operator()(const Rational_kernel::Triangle_3& t) const {
    for (int i = 0; i < 3; ++i) points.push_back(nearest_point(t[i]));
  }
  void operator()(const std::vector<Rational_kernel::Point_3>& polygon) const {
    for (const auto& p : polygon) points.push_back(nearest_point(p));
  }
};

struct Shapes_intersection {
  Intersection_points& points;

  void operator()(const Rational_kernel::Point_3& a, const Rational_kernel::Point_3& b) const {
    if (a == b) points.push_back(nearest_point(a));
  }
  template <class A, class B>
  void operator()(const A& a, const B& b) const {
    if (const auto result = CGAL::intersection(a, b)) boost::apply_visitor(Collect_points{points}, *result);
  }
};

/// The edge of a `Crossing`: its triangle, and its ends, the one above the other triangle first.
struct Crossing_edge {
  std::uint8_t owner;  ///< 0: a
  std::uint8_t above, below;
};
/// By code. A table, because branches on the code would be unpredictable.
constexpr auto crossing_edges = [] {
  std::array<Crossing_edge, no_crossing> edges{};
  for (std::uint8_t code = 0; code < no_crossing; ++code) {
    const std::uint8_t owner = code % 6 / 3, corner = code % 3, next = (code + 1) % 3;
    edges[code] = code < 6 ? Crossing_edge{owner, corner, next} : Crossing_edge{owner, next, corner};
  }
  return edges;
}();

/// Whether the segment from p to q is proven to pass through the interior of a triangle, from above to below; `false`
/// proves nothing. If it does, all five orientations are positive, so the branches are predictable.
///
/// CGAL's filter branches on whether the points are spread wider along z than along x and y, which is unpredictable. So
/// z is stretched by a power of two. That does not round, and it changes no orientation.
bool passes_through(const double* p, const double* q, const Triangle_corners& t) {
  constexpr double stretch = 0x1p10;
  const auto stretched = [](const double* from) { return Point(from[0], from[1], stretch * from[2]); };
  const Point points[]{stretched(p), stretched(q), stretched(t[0]), stretched(t[1]), stretched(t[2])};
  double largest = 0;
  for (const Point& point : points) largest = std::max(largest, std::abs(point.z()));
  const auto points_at = [&points](int a, int b, int c, int d) {
    return Point_quadruple{&points[a], &points[b], &points[c], &points[d]};
  };
  return std::isfinite(largest) &&
         all_positive(std::array{points_at(2, 3, 4, 0), points_at(2, 4, 3, 1), points_at(1, 0, 2, 3),
                                 points_at(1, 0, 3, 4), points_at(1, 0, 4, 2)});
}

/// Whether a corner of one is a corner of the other, as of two copies of a surface in one place, where predicates would
/// need exact numbers.
bool have_a_common_corner(const Triangle& a, const Triangle& b) {
  return std::ranges::any_of(a, [&](const Point& p) {
    return std::ranges::any_of(b, [&](const Point& q) { return p.x() == q.x() && p.y() == q.y() && p.z() == q.z(); });
  });
}

bool have_area(const Triangle& a, const Triangle& b) {
  const auto has_area = [](const Triangle& t) { return surely_not_collinear(t) || !CGAL::collinear(t[0], t[1], t[2]); };
  return has_area(a) && has_area(b);
}

/// The intersection of triangles of which some may be segments or points.
Intersection_points shapes_intersection(const Triangle& a, const Triangle& b) {
  const auto rational_shape = [](const Triangle& t) {
    return shape<Rational_kernel>(rational(t[0]), rational(t[1]), rational(t[2]));
  };
  Intersection_points points;
  std::visit(Shapes_intersection{points}, rational_shape(a), rational_shape(b));
  put_in_order(points);
  return points;
}

}  // namespace

bool triangles_intersect(const Triangle& a, const Triangle& b) {
  if (have_a_common_corner(a, b)) return true;
  if (surely_not_collinear(a) && surely_not_collinear(b))
    return CGAL::CommonKernelFunctors::Do_intersect_3<Staged_kernel>()(Kernel::Triangle_3(a[0], a[1], a[2]),
                                                                       Kernel::Triangle_3(b[0], b[1], b[2]));
  return std::visit(Shapes_intersect(), shape<Kernel>(a[0], a[1], a[2]), shape<Kernel>(b[0], b[1], b[2]));
}

bool triangles_intersect_given(const Triangle_corners& a, const Triangle_corners& b, Crossing likely) {
  if (likely < no_crossing) {
    const Triangle_corners* const triangles[]{&a, &b};
    const auto [owner, above, below] = crossing_edges[likely];
    const Triangle_corners& edges = *triangles[owner];
    if (passes_through(edges[above], edges[below], *triangles[1 - owner])) return true;
  }
  return triangles_intersect(triangle_of(a), triangle_of(b));
}

bool segment_intersects(const Point& p, const Point& q, const Triangle& triangle) {
  const Triangle_corners corners{&*triangle[0].cartesian_begin(), &*triangle[1].cartesian_begin(),
                                 &*triangle[2].cartesian_begin()};
  const double *from = &*p.cartesian_begin(), *to = &*q.cartesian_begin();
  return passes_through(from, to, corners) || passes_through(to, from, corners) ||
         triangles_intersect({p, q, q}, triangle);
}

Intersection_points triangle_intersection(const Triangle& a, const Triangle& b) {
  const Triangle_pair pair{a, b};
  Intersection_points points;
  triangle_intersections({&pair, 1}, {&points, 1});
  return points;
}

void triangle_intersections(std::span<const Triangle_pair> pairs, std::span<Intersection_points> intersections) {
  std::array<std::optional<Crossing_segment>, most_crossing_pairs> segments;
  for (std::size_t first = 0; first < pairs.size(); first += most_crossing_pairs) {
    const auto batch = pairs.subspan(first, std::min(most_crossing_pairs, pairs.size() - first));
    crossing_segments(batch, segments);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const auto& [a, b] = batch[i];
      if (segments[i])
        intersections[first + i].assign(segments[i]->begin(), segments[i]->end());
      else
        intersections[first + i] = have_area(a, b) ? shared_corners(a, b) : shapes_intersection(a, b);
    }
  }
}

}  // namespace lodestone
