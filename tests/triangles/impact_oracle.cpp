// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/impact_oracle.h"

#include <CGAL/Intersections_3/Segment_3_Segment_3.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {

namespace {

using Exact = CGAL::Simple_cartesian<Rational>;
using Shape = std::variant<Exact::Point_3, Exact::Segment_3, Exact::Triangle_3>;

/// The point set of a triangle: its extreme points in lexicographic order are the ends, if its corners are collinear.
Shape shape_at(const Moving_triangle& moving, const Rational& t) {
  std::vector<Exact_point> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const Exact_point start = exact_point(moving.start[i]);
    corners.push_back(start + t * (exact_point(moving.end[i]) - start));
  }
  if (!CGAL::collinear(corners[0], corners[1], corners[2]))
    return Exact::Triangle_3(corners[0], corners[1], corners[2]);
  std::ranges::sort(corners);
  if (corners[0] == corners[2]) return corners[0];
  return Exact::Segment_3(corners[0], corners[2]);
}

struct Meet {
  bool operator()(const Exact_point& a, const Exact_point& b) const { return a == b; }
  bool operator()(const Exact_point& a, const Exact::Segment_3& b) const { return b.has_on(a); }
  bool operator()(const Exact_point& a, const Exact::Triangle_3& b) const { return b.has_on(a); }
  bool operator()(const Exact::Segment_3& a, const Exact_point& b) const { return a.has_on(b); }
  bool operator()(const Exact::Triangle_3& a, const Exact_point& b) const { return a.has_on(b); }
  template <class A, class B>
  bool operator()(const A& a, const B& b) const {
    return CGAL::do_intersect(a, b);
  }
};

Point between(const Point& p, const Point& q, double t) {
  const auto along = [t](double x, double y) { return (1 - t) * x + t * y; };
  return {along(p.x(), q.x()), along(p.y(), q.y()), along(p.z(), q.z())};
}

double greatest_speed(const Moving_triangle& moving) {
  double speed = 0;
  for (std::size_t i = 0; i < 3; ++i)
    speed = std::max(speed, std::sqrt(CGAL::squared_distance(moving.start[i], moving.end[i])));
  return speed;
}

}  // namespace

bool meet_at(const Moving_triangle& a, const Moving_triangle& b, const Rational& t) {
  return std::visit(Meet(), shape_at(a, t), shape_at(b, t));
}

std::vector<Rational> fractions(int largest_denominator) {
  std::vector<Rational> all;
  for (int d = 1; d <= largest_denominator; ++d)
    for (int n = 0; n <= d; ++n) all.push_back(Rational(n) / Rational(d));
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// By continued fractions.
Rational simplest_between(const Rational& low, const Rational& high) {
  Rational whole = std::floor(CGAL::to_double(low));
  while (whole > low) whole -= 1;
  while (whole + 1 <= low) whole += 1;
  if (whole + 1 < high) return whole + 1;
  if (whole == low) {
    Rational part = 2;
    while (low + 1 / part >= high) part += 1;
    return low + 1 / part;
  }
  return whole + 1 / simplest_between(1 / Rational(high - whole), 1 / Rational(low - whole));
}

std::optional<double> advance(const Moving_triangle& a, const Moving_triangle& b, double near) {
  const double speed = greatest_speed(a) + greatest_speed(b);
  double t = 0;
  for (;;) {
    const double distance = closest_points(rounded_at(a, t), rounded_at(b, t)).distance;
    if (distance < near) return t;
    if (!(speed * (1 - t) > 0.99 * distance)) return std::nullopt;
    t += 0.99 * distance / speed;
  }
}

Triangle rounded_at(const Moving_triangle& moving, double t) {
  const auto corner = [&](std::size_t i) { return between(moving.start[i], moving.end[i], t); };
  return {corner(0), corner(1), corner(2)};
}

}  // namespace lodestone
