// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/point_distance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace lodestone {

namespace {

using Vector = Eigen::Vector3d;

/// The power of two that brings differences near 1, as far as no scaled coordinate overflows.
double power_for(const Point& point, const double* low, const double* high) {
  double difference = 0, coordinate = 0;
  for (int axis = 0; axis < 3; ++axis) {
    difference = std::max({difference, std::abs(low[axis] - point[axis]), std::abs(high[axis] - point[axis])});
    coordinate = std::max({coordinate, std::abs(low[axis]), std::abs(high[axis]), std::abs(point[axis])});
  }
  if (!(difference > 0)) return 1;
  const int exponent = std::isfinite(difference) ? std::ilogb(difference) : 1023;
  return std::ldexp(1.0, std::clamp(-exponent, -1022, std::min(1023, 1000 - std::ilogb(coordinate))));
}

Nearest_part corner_part(std::uint32_t vertex) { return {vertex, vertex}; }
Nearest_part edge_part(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The nearest point of a triangle to the origin, by the regions of \cite ericson2005. The origin is the query.
///
/// Let u = 2^-53, m the greatest distance of a corner, s the greatest length of an edge. Corners and edges are
/// differences of coordinates, rounded once. A product of an edge and a corner has terms of at most s m in total size
/// 3 s m, each with five roundings, so its error is below 16 u s m. A difference of two products of these is off by
/// less than 4 * 16 u s^2 m^2 + 4 u s^2 m^2. Twice as much is allowed for both.
struct Region_search {
  Vector a, b, c, ab, ac;
  double product_error, area_error;
  const std::array<std::uint32_t, 3>& vertices;
  const Point& query;
  const Triangle_corners& corners;
  Distance_estimate found = {};

  void run() {
    const double d1 = -ab.dot(a), d2 = -ac.dot(a), d3 = -ab.dot(b), d4 = -ac.dot(b), d5 = -ab.dot(c), d6 = -ac.dot(c);
    const double e = product_error;
    if (d1 <= 0 && d2 <= 0) return at_corner(0, 0, 0, d1 < -e && d2 < -e);
    if (d3 >= 0 && d4 <= d3) return at_corner(1, 1, 0, d3 > e && d3 - d4 > 3 * e);
    if (d6 >= 0 && d5 <= d6) return at_corner(2, 0, 1, d6 > e && d6 - d5 > 3 * e);
    const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
    if (of_c <= 0 && d1 >= 0 && d3 <= 0) {
      const double part = d1 / (d1 - d3);
      return on_edge(0, 1, part, 0, of_c < -area_error && d1 > e && d3 < -e);
    }
    if (of_b <= 0 && d2 >= 0 && d6 <= 0) {
      const double part = d2 / (d2 - d6);
      return on_edge(0, 2, 0, part, of_b < -area_error && d2 > e && d6 < -e);
    }
    if (of_a <= 0 && d4 >= d3 && d5 >= d6) {
      const double part = (d4 - d3) / ((d4 - d3) + (d5 - d6));
      return on_edge(1, 2, 1 - part, part, of_a < -area_error && d4 - d3 > 3 * e && d5 - d6 > 3 * e);
    }
    const double all = of_a + of_b + of_c;
    // Each area is positive here. The limits keep the point in the triangle without a proof of that.
    const double weight_b = std::clamp(of_b / all, 0.0, 1.0);
    found.weights = {weight_b, std::clamp(of_c / all, 0.0, 1 - weight_b)};
  }

  void at_corner(std::size_t corner, double weight_b, double weight_c, bool sure) {
    found.weights = {weight_b, weight_c};
    if (sure || lies_behind(corner)) found.part = corner_part(vertices[corner]);
  }
  /// Whether no edge from the corner leads towards the query along any axis: then the corner is nearest. Exact, since
  /// only coordinates are compared. Needed above the centre of a disc or cone, where products vanish and all faces have
  /// the same corner nearest.
  bool lies_behind(std::size_t corner) const {
    const double* const at = corners[corner];
    const auto leads_away = [&](const double* other) {
      for (int axis = 0; axis < 3; ++axis)
        if ((other[axis] > at[axis] && query[axis] > at[axis]) || (other[axis] < at[axis] && query[axis] < at[axis]))
          return false;
      return true;
    };
    return leads_away(corners[(corner + 1) % 3]) && leads_away(corners[(corner + 2) % 3]);
  }
  void on_edge(int from, int to, double weight_b, double weight_c, bool sure) {
    found.weights = {weight_b, weight_c};
    if (sure) found.part = edge_part(vertices[static_cast<std::size_t>(from)], vertices[static_cast<std::size_t>(to)]);
  }
};

/// Of a triangle that has the query as a corner.
Distance_estimate no_distance(std::size_t corner, std::uint32_t vertex) {
  Distance_estimate found{.low = 0, .high = 0, .part = corner_part(vertex)};
  if (corner > 0) found.weights[corner - 1] = 1;
  return found;
}

}  // namespace

Query_point::Query_point(const Point& p, const double* low, const double* high)
    : point(p), scale(power_for(p, low, high)) {}

/// The point with the weights found is a point of the triangle, up to 16 roundings of m, so its distance is an upper
/// bound. The plane through it, orthogonal to the gap, gives a lower bound: the least product of the gap and a corner,
/// which is off by less than 15 u |gap| m, over the length of the gap. Neither depends on how well the weights are
/// rounded.
Distance_estimate estimate_distance(const Query_point& query, const Triangle_corners& corners,
                                    const std::array<std::uint32_t, 3>& vertices) {
  constexpr double underflow = 0x1p-1000;
  const auto difference = [&](const double* p, const auto& q) {
    return Vector(p[0] * query.scale - q[0] * query.scale, p[1] * query.scale - q[1] * query.scale,
                  p[2] * query.scale - q[2] * query.scale);
  };
  for (std::size_t i = 0; i < 3; ++i)
    if (corners[i][0] == query.point.x() && corners[i][1] == query.point.y() && corners[i][2] == query.point.z())
      return no_distance(i, vertices[i]);
  Region_search search{.a = difference(corners[0], query.point),
                       .b = difference(corners[1], query.point),
                       .c = difference(corners[2], query.point),
                       .ab = difference(corners[1], corners[0]),
                       .ac = difference(corners[2], corners[0]),
                       .product_error = 0,
                       .area_error = 0,
                       .vertices = vertices,
                       .query = query.point,
                       .corners = corners};
  const double m2 = std::max({search.a.squaredNorm(), search.b.squaredNorm(), search.c.squaredNorm()});
  const double s2 = std::max({search.ab.squaredNorm(), search.ac.squaredNorm(), (search.b - search.c).squaredNorm()});
  // Roots, for the product of two small squares can underflow.
  const double m = std::sqrt(m2);
  search.product_error = 0x1p-48 * (std::sqrt(s2) * m) + underflow;
  search.area_error = 0x1p-46 * s2 * m2 + underflow;
  search.run();
  Distance_estimate& found = search.found;
  const Vector gap = search.a + found.weights[0] * search.ab + found.weights[1] * search.ac;
  const double squared = gap.squaredNorm(), length_times_m = std::sqrt(squared) * m;
  if (!std::isfinite(squared)) return {};  // weights of a triangle without area
  found.squared = squared;
  found.high = squared + 0x1p-46 * length_times_m + 0x1p-90 * m2 + underflow;
  const double least = std::min({gap.dot(search.a), gap.dot(search.b), gap.dot(search.c)});
  const double proven = least - 0x1p-48 * length_times_m - underflow;
  found.low = proven > 0 ? proven * (proven / squared) * (1 - 0x1p-48) : 0;
  return found;
}

Exact_squared exact_squared_distance(const Point& point, const Triangle& triangle) {
  using Number = Exact_squared::NT;
  using Exact_vector = std::array<Number, 3>;
  const auto difference = [](const Point& p, const Point& q) -> Exact_vector {
    return {Number(p.x()) - Number(q.x()), Number(p.y()) - Number(q.y()), Number(p.z()) - Number(q.z())};
  };
  const auto dot = [](const Exact_vector& u, const Exact_vector& v) -> Number {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const auto cross = [](const Exact_vector& u, const Exact_vector& v) -> Exact_vector {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  std::array<Exact_vector, 3> corners, edges;
  std::array<Number, 3> squares;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = difference(triangle[i], point);
    edges[i] = difference(triangle[(i + 1) % 3], triangle[i]);
    squares[i] = dot(corners[i], corners[i]);
  }
  Exact_squared least = std::min({squares[0], squares[1], squares[2]});
  for (std::size_t i = 0; i < 3; ++i) {
    const Number along = -dot(corners[i], edges[i]);
    if (!CGAL::is_positive(along)) continue;
    const Number length = dot(edges[i], edges[i]);
    if (along < length) least = std::min(least, Exact_squared(squares[i] * length - along * along, length));
  }
  const Exact_vector normal = cross(edges[0], edges[1]);
  const Number squared_normal = dot(normal, normal);
  if (CGAL::is_zero(squared_normal)) return least;
  // The foot is within the face if it is on the inner side of each edge.
  for (std::size_t i = 0; i < 3; ++i)
    if (CGAL::is_positive(dot(cross(edges[i], corners[i]), normal))) return least;
  const Number height = dot(corners[0], normal);
  return {height * height, squared_normal};
}

}  // namespace lodestone
