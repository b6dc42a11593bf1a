// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/triangle_distance.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "triangles/double_double.h"
#include "triangles/nearest_points.h"
#include "triangles/triangle_box.h"

namespace lodestone {

namespace {

using Exact_number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

/// Eight times the largest relative error of an operation: more than any error that this file bounds by it.
template <class Number>
constexpr double roundings = 0x1p-50;
template <>
constexpr double roundings<Double_double> = 0x1p-96;

/// Above what underflow takes from any sum of products of scaled numbers here.
constexpr double underflow = 1e-300;

template <class Number>
using Difference = typename Corner_differences<Number>::Vector;

/// Sum of the absolute coordinates.
template <class Number>
double size(const Difference<Number>& v) {
  return std::abs(double(v[0])) + std::abs(double(v[1])) + std::abs(double(v[2]));
}

/// Lower bound on the distance of triangles with these scaled differences: how far apart they are across a plane
/// orthogonal to `across`; 0 if no such plane separates them. In the unit of the differences.
///
/// The inner product of a difference with `across` carries the roundings of the difference, of three products and of
/// two sums: four in each term.
template <class Number>
double separation(const Corner_differences<Number>& d, const Difference<Number>& across) {
  constexpr double of_double = roundings<double>;
  const double squared(across.squaredNorm());
  if (!(squared > 1e-280)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& row : d.between)
    for (const auto& difference : row) {
      const Difference<Number> terms = difference.cwiseProduct(across);
      const double height = double(terms.sum()) - roundings<Number> * size<Number>(terms);
      if (!(height > 0)) return 0;
      least = std::min(least, height);
    }
  least -= underflow;
  return least > 0 ? least / (std::sqrt(squared) * (1 + of_double)) : 0;
}

/// A pair of near points, and the proven lower bound on the distance of the triangles. Lengths here are scaled: times
/// 2^exponent they are those of the triangles.
template <class Number>
class Estimate {
 public:
  Estimate(const Triangle& a, const Triangle& b)
      : scaled_(scaled_differences<Number>(a, b)), nearest_(Nearest_points_search(scaled_.vectors)()) {
    const double squared(nearest_.squared);
    distance_ = squared > 1e-280 ? std::sqrt(squared) : gap().stableNorm();
    at_least_ = separation(scaled_.vectors, nearest_.across);
    // Four roundings in each term of the gap, three in its length.
    const auto way = [&](const std::array<Difference<Number>, 3>& edges, const Triangle_point<Number>& p) {
      return double(p.s) * size<Number>(edges[static_cast<std::size_t>(p.corner)]) +
             double(p.r) * size<Number>(edges[static_cast<std::size_t>((p.corner + 2) % 3)]);
    };
    error_ = roundings<Number> * (size<Number>(gap_of_corners()) + way(scaled_.vectors.edges_a, nearest_.a) +
                                  way(scaled_.vectors.edges_b, nearest_.b)) +
             underflow;
  }

  const Nearest_points<Number>& unrounded_points() const { return nearest_; }
  /// s and r are rounded; their sum stays at most 1.
  Nearest_points<double> points() const {
    const auto rounded_point = [](const Triangle_point<Number>& p) {
      const double s(p.s), r(p.r);
      return Triangle_point<double>{p.corner, s, r > 0 ? std::min(r, std::nextafter(1 - s, 0.0)) : r};
    };
    return {rounded_point(nearest_.a), rounded_point(nearest_.b), {}, {}};
  }
  double distance() const { return std::ldexp(distance_, scaled_.exponent); }
  Eigen::Vector3d direction() const { return gap().stableNormalized(); }

  /// Whether the triangles are proven not to intersect.
  bool proves_apart() const { return at_least_ > 0; }

  /// Whether the relative error of `distance` is proven to be at most 2^-31.
  bool proves_accuracy() {
    const auto accurate = [&] { return std::max(std::abs(distance_ - at_least_), error_) <= 0x1p-31 * at_least_; };
    return accurate() || (try_more_planes(), accurate());
  }

  /// Whether the triangles are proven to be `limit` apart or more.
  bool proves_apart(double limit) {
    // The scaled limit is rounded only where it underflows.
    const double scaled_limit = std::ldexp(limit, -scaled_.exponent) + underflow;
    if (at_least_ >= scaled_limit) return true;
    if (distance_ < scaled_limit) return false;
    try_more_planes();
    return at_least_ >= scaled_limit;
  }

 private:
  const Difference<Number>& gap_of_corners() const {
    return scaled_.vectors
        .between[static_cast<std::size_t>(nearest_.a.corner)][static_cast<std::size_t>(nearest_.b.corner)];
  }
  Eigen::Vector3d gap() const { return {double(nearest_.gap[0]), double(nearest_.gap[1]), double(nearest_.gap[2])}; }

  /// A short gap has few correct digits. Planes along a face, or along an edge of each triangle, do not depend on the
  /// gap.
  void try_more_planes() {
    const auto& [between, edges_a, edges_b] = scaled_.vectors;
    const auto try_plane = [&](const Difference<Number>& normal) {
      const Difference<Number> across = normal.dot(nearest_.gap) < 0 ? Difference<Number>(-normal) : normal;
      at_least_ = std::max(at_least_, separation(scaled_.vectors, across));
    };
    try_plane(edges_a[0].cross(edges_a[1]));
    try_plane(edges_b[0].cross(edges_b[1]));
    for (const auto& e : edges_a)
      for (const auto& f : edges_b) try_plane(e.cross(f));
  }

  Scaled_differences<Number> scaled_;
  Nearest_points<Number> nearest_;
  double distance_ = 0;  ///< between the points, as computed
  double error_ = 0;     ///< of that computation, at most
  double at_least_ = 0;  ///< lower bound on the distance of the triangles
};

/// Coordinate of a point of a triangle.
template <class Number>
Number coordinate(const Triangle& t, const Triangle_point<Number>& p, int axis) {
  const auto corner = [&](int i) { return Number(t[(p.corner + i) % 3][axis]); };
  return corner(0) + p.s * (corner(1) - corner(0)) + p.r * (corner(2) - corner(0));
}

template <class Number>
Number converted(double x) {
  return Number(x);
}
template <class Number>
Number converted(const Double_double& x) {
  const double high(x), low(x - Double_double(high));
  return Number(high) + Number(low);
}
template <class Number, class From>
Triangle_point<Number> converted(const Triangle_point<From>& p) {
  return {p.corner, converted<Number>(p.s), converted<Number>(p.r)};
}

/// Whether a pair of points is proven to be nearer than `limit`. Even if s and r are rounded, they name points of the
/// triangles as long as their sum is at most 1.
template <class Number, class From>
bool surely_nearer(const Triangle& a, const Triangle& b, const Nearest_points<From>& points, double limit) {
  const auto on_a = converted<Number>(points.a), on_b = converted<Number>(points.b);
  if (!CGAL::certainly(on_a.s + on_a.r <= 1) || !CGAL::certainly(on_b.s + on_b.r <= 1)) return false;
  Number squared = 0;
  for (int axis = 0; axis < 3; ++axis) squared += CGAL::square(coordinate(a, on_a, axis) - coordinate(b, on_b, axis));
  return CGAL::certainly(squared < CGAL::square(Number(limit)));
}
bool surely_nearer_in_intervals(const Triangle& a, const Triangle& b, const Nearest_points<double>& points,
                                double limit) {
  const CGAL::Protect_FPU_rounding<true> upwards;
  return surely_nearer<CGAL::Interval_nt<false>>(a, b, points, limit);
}

/// Exact numbers for sums and products, much faster than those that can be divided.
using Ring = Kernel::Exact_kernel_rt;

/// The direction of the gap between the corner, edge or face that each of two near points lies on, of any length,
/// without rounding.
/// @param corners  of a and of b
Ring::Vector_3 exact_gap_direction(const std::array<std::array<Ring::Point_3, 3>, 2>& corners,
                                   const Nearest_points<double>& near) {
  const std::array points{near.a, near.b};
  const auto edge = [&](std::size_t t, int after) {
    const auto corner = [&](int i) { return corners[t][static_cast<std::size_t>((points[t].corner + i) % 3)]; };
    return corner(after + 1) - corner(after);
  };
  const Ring::Vector_3 gap =
      corners[0][static_cast<std::size_t>(near.a.corner)] - corners[1][static_cast<std::size_t>(near.b.corner)];
  const auto along_gap = [&gap](const Ring::Vector_3& normal) { return normal * gap < 0 ? -normal : normal; };
  if (near.a.r > 0) return along_gap(CGAL::cross_product(edge(0, 0), edge(0, 1)));
  if (near.b.r > 0) return along_gap(CGAL::cross_product(edge(1, 0), edge(1, 1)));
  if (near.a.s > 0 && near.b.s > 0) return along_gap(CGAL::cross_product(edge(0, 0), edge(1, 0)));
  if (near.a.s == 0 && near.b.s == 0) return gap;
  const Ring::Vector_3 of_edge = near.a.s > 0 ? edge(0, 0) : edge(1, 0);
  return gap * of_edge.squared_length() - of_edge * (gap * of_edge);
}

/// Whether a plane orthogonal to the gap proves the triangles to be `limit` apart or more. Nothing is rounded, so it
/// fails only if the triangles are nearer, or if the gap is not where they are nearest.
bool exactly_apart(const Triangle& a, const Triangle& b, const Nearest_points<double>& near, double limit) {
  const auto exact = [](const Triangle& t) {
    const auto point = [&t](std::size_t i) { return Ring::Point_3(t[i].x(), t[i].y(), t[i].z()); };
    return std::array{point(0), point(1), point(2)};
  };
  const std::array corners{exact(a), exact(b)};
  const Ring::Vector_3 across = exact_gap_direction(corners, near);
  const auto heights = [&](std::size_t t) {
    const auto height = [&](std::size_t i) { return across * (corners[t][i] - CGAL::ORIGIN); };
    return std::minmax({height(0), height(1), height(2)});
  };
  const Ring::FT gap = heights(0).first - heights(1).second;
  return gap > 0 && CGAL::square(gap) >= CGAL::square(Ring::FT(limit)) * across.squared_length();
}

Nearest_points<Exact_number> exact_nearest_points(const Triangle& a, const Triangle& b) {
  const auto differences = corner_differences<Exact_number>(a, b, [](double x) { return Exact_number(x); });
  return Nearest_points_search(differences)();
}

double rounded(const Exact_number& x) {
  // Without exact() a lazy number converts to the midpoint of its interval, which may be off in the last digits.
  x.exact();
  const double middle = CGAL::to_double(x);
  // The sum of its two ends may overflow. The exact number is rounded towards zero, so that a small one would vanish.
  return std::isfinite(middle) ? middle : CGAL::to_double(CGAL::exact(x));
}

/// Rounded only after scaling to a largest coordinate of 1, so the direction of even the shortest gap has all digits.
Eigen::Vector3d direction(const Nearest_points<Exact_number>& nearest) {
  Exact_number greatest = 0;
  for (int axis = 0; axis < 3; ++axis) greatest = std::max(greatest, CGAL::abs(nearest.gap[axis]));
  const auto part = [&](int axis) { return rounded(nearest.gap[axis] / greatest); };
  return Eigen::Vector3d(part(0), part(1), part(2)).normalized();
}

Point point(const Triangle& t, const Triangle_point<Exact_number>& p) {
  return {rounded(coordinate(t, p, 0)), rounded(coordinate(t, p, 1)), rounded(coordinate(t, p, 2))};
}

/// A weighted mean of the corners, which cannot overflow.
Point point(const Triangle& t, const Triangle_point<double>& p) {
  const auto mean = [&](int axis) {
    const auto corner = [&](int i) { return t[(p.corner + i) % 3][axis]; };
    return (1 - p.s - p.r) * corner(0) + p.s * corner(1) + p.r * corner(2);
  };
  return {mean(0), mean(1), mean(2)};
}

/// upper - lower, rounded down. If it overflows, infinity.
double difference_rounded_down(double upper, double lower) {
  const double gap = upper - lower, of_lower = upper - gap, of_upper = gap + of_lower;
  const double left_out = (upper - of_upper) + (of_lower - lower);  // by the rounding of the gap \cite knuth1969
  return left_out < 0 ? std::nextafter(gap, 0.0) : gap;
}

/// Whether the boxes are `distance` apart or more along one axis. Exact, since a gap as wide as the distance is what
/// people lay out: a box above a floor, parts with a clearance.
bool apart_along_an_axis(const Box& a, const Box& b, double distance) {
  for (int axis = 0; axis < 3; ++axis)
    if (difference_rounded_down(a.min()[axis], b.max()[axis]) >= distance ||
        difference_rounded_down(b.min()[axis], a.max()[axis]) >= distance)
      return true;
  return false;
}

double positive(double distance) { return std::max(distance, std::numeric_limits<double>::denorm_min()); }

}  // namespace

Closest_points closest_points(const Triangle& a, const Triangle& b) {
  const auto estimated = [&](const auto& estimate) -> Closest_points {
    const auto points = estimate.points();
    return {point(a, points.a), point(b, points.b), positive(estimate.distance()), estimate.direction()};
  };
  Estimate<double> estimate(a, b);
  if (estimate.proves_accuracy()) return estimated(estimate);
  if (!estimate.proves_apart() && triangles_intersect(a, b)) {
    const Point common = triangle_intersection(a, b).front();
    return {.a = common, .b = common};
  }
  Estimate<Double_double> finer(a, b);
  if (finer.proves_accuracy()) return estimated(finer);
  const auto nearest = exact_nearest_points(a, b);
  const auto& gap = nearest.gap;
  return {point(a, nearest.a), point(b, nearest.b),
          positive(std::hypot(rounded(gap[0]), rounded(gap[1]), rounded(gap[2]))), direction(nearest)};
}

bool corners_nearer_than(const Triangle_corners& a, const Triangle_corners& b, double distance) {
  // The square of a distance is off by some 10^-15 of it, and by less than 10^-300 where it underflows.
  const double limit = distance * distance * (1 - 0x1p-40);
  if (!(limit > 1e-280)) return false;
  double least = std::numeric_limits<double>::infinity();
  for (const double* p : a)
    for (const double* q : b) {
      double squared = 0;
      for (int axis = 0; axis < 3; ++axis) squared += (p[axis] - q[axis]) * (p[axis] - q[axis]);
      least = std::min(least, squared);
    }
  return least < limit;
}

bool triangles_nearer_than(const Triangle& a, const Triangle& b, double distance) {
  if (!(distance > 0)) return triangles_intersect(a, b);
  if (!std::isfinite(distance)) return true;
  const Box box_a = box_of(a), box_b = box_of(b);
  if (distance_lower_bound(box_a, box_b) >= distance || apart_along_an_axis(box_a, box_b, distance)) return false;
  Estimate<double> estimate(a, b);
  if (estimate.proves_apart(distance)) return false;
  if (surely_nearer_in_intervals(a, b, estimate.points(), distance)) return true;
  if (!estimate.proves_apart() && triangles_intersect(a, b)) return true;
  const Estimate<Double_double> finer(a, b);
  if (surely_nearer<Ring::FT>(a, b, finer.unrounded_points(), distance)) return true;
  if (exactly_apart(a, b, finer.points(), distance)) return false;
  return exact_nearest_points(a, b).squared < CGAL::square(Exact_number(distance));
}

double distance_lower_bound(const Box& a, const Box& b) {
  constexpr double down = 1 - roundings<double>;
  const Eigen::Array3d gaps = (a.min() - b.max()).cwiseMax(b.min() - a.max()).cwiseMax(0.0);
  Eigen::Index axis = 0;
  const double greatest = gaps.maxCoeff(&axis);
  constexpr double largest_number = std::numeric_limits<double>::max();
  // Boxes that overlap along the other axes are as far apart as their sides: a bound that ties can be told by.
  if (greatest > 0 && gaps.sum() == greatest)
    return std::min(std::max(difference_rounded_down(a.min()[axis], b.max()[axis]),
                             difference_rounded_down(b.min()[axis], a.max()[axis])),
                    largest_number);
  // If a square could overflow or underflow, the largest coordinate is the bound. A subnormal gap is exact and stays
  // so.
  const double bound = greatest > 1e-150 && greatest < 1e150 ? std::sqrt(gaps.square().sum()) : greatest;
  return std::min(bound * down, largest_number);
}

}  // namespace lodestone
