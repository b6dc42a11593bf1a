// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/triangle_intersection.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Segment_3.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

namespace lodestone {

namespace {

/// Proves in floating point that three points are not collinear. Each component of the cross product carries an error
/// below 8 roundings of the sum of its two products; `false` proves nothing.
bool surely_not_collinear(const Triangle& t) {
  constexpr double bound = 1e-14;
  const double ux = t[1].x() - t[0].x(), uy = t[1].y() - t[0].y(), uz = t[1].z() - t[0].z();
  const double vx = t[2].x() - t[0].x(), vy = t[2].y() - t[0].y(), vz = t[2].z() - t[0].z();
  const auto away_from_zero = [](double p, double q) {
    // Where a product is subnormal its relative error is no longer small.
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

/// CGAL's reader of a point against a point is an equality test; everything else is its `do_intersect`.
struct Shapes_intersect {
  bool operator()(const Point& a, const Point& b) const { return a == b; }
  template <class A, class B>
  bool operator()(const A& a, const B& b) const {
    return CGAL::do_intersect(a, b);
  }
};

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

Exact::Point_3 exact(const Point& p) { return {p.x(), p.y(), p.z()}; }

Point rounded(const Exact::Point_3& p) {
  // exact() first: a lazy number gives its interval's midpoint otherwise, which may be off in the last digits.
  p.exact();
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

struct Collect_points {
  Intersection_points& points;

  void operator()(const Exact::Point_3& p) const { points.push_back(rounded(p)); }
  void operator()(const Exact::Segment_3& s) const {
    for (const auto& end : {s.source(), s.target()}) points.push_back(rounded(end));
  }
  void operator()(const Exact::Triangle_3& t) const {
    for (int i = 0; i < 3; ++i) points.push_back(rounded(t[i]));
  }
  void operator()(const std::vector<Exact::Point_3>& polygon) const {
    for (const auto& p : polygon) points.push_back(rounded(p));
  }
};

struct Shapes_intersection {
  Intersection_points& points;

  void operator()(const Exact::Point_3& a, const Exact::Point_3& b) const {
    if (a == b) points.push_back(rounded(a));
  }
  template <class A, class B>
  void operator()(const A& a, const B& b) const {
    if (const auto result = CGAL::intersection(a, b)) boost::apply_visitor(Collect_points{points}, *result);
  }
};

/// The edge of a `Crossing`: which triangle has it, and its ends, that above the other triangle first.
struct Crossing_edge {
  std::uint8_t owner;  ///< 0: a
  std::uint8_t above, below;
};
/// By number. No branch could foretell it.
constexpr auto crossing_edges = [] {
  std::array<Crossing_edge, no_crossing> edges{};
  for (std::uint8_t number = 0; number < no_crossing; ++number) {
    const std::uint8_t owner = number % 6 / 3, corner = number % 3, next = (number + 1) % 3;
    edges[number] = number < 6 ? Crossing_edge{owner, corner, next} : Crossing_edge{owner, next, corner};
  }
  return edges;
}();

/// Whether the segment from p to q passes through the inside of a triangle, from above to below; `false` proves
/// nothing. All orientations are the same if it does, so a processor foresees what comes of each.
///
/// CGAL's filter branches on whether its points are spread wider along z than along x and y, which no processor
/// foresees. So z is stretched, by a power of two: that rounds nothing and changes no orientation.
bool passes_through(const double* p, const double* q, const Triangle_corners& t) {
  constexpr double stretch = 0x1p10;
  const auto stretched = [](const double* from) { return Point(from[0], from[1], stretch * from[2]); };
  const Point points[]{stretched(p), stretched(q), stretched(t[0]), stretched(t[1]), stretched(t[2])};
  double largest = 0;
  for (const Point& point : points) largest = std::max(largest, std::abs(point.z()));
  const auto positive = [&points](int a, int b, int c, int d) {
    return CGAL::orientation(points[a], points[b], points[c], points[d]) == CGAL::POSITIVE;
  };
  return std::isfinite(largest) && positive(2, 3, 4, 0) && positive(2, 4, 3, 1) && positive(1, 0, 2, 3) &&
         positive(1, 0, 3, 4) && positive(1, 0, 4, 2);
}

}  // namespace

bool triangles_intersect(const Triangle& a, const Triangle& b) {
  if (surely_not_collinear(a) && surely_not_collinear(b))
    return CGAL::do_intersect(Kernel::Triangle_3(a[0], a[1], a[2]), Kernel::Triangle_3(b[0], b[1], b[2]));
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

Intersection_points triangle_intersection(const Triangle& a, const Triangle& b) {
  Intersection_points points;
  std::visit(Shapes_intersection{points}, shape<Exact>(exact(a[0]), exact(a[1]), exact(a[2])),
             shape<Exact>(exact(b[0]), exact(b[1]), exact(b[2])));
  return points;
}

}  // namespace lodestone
