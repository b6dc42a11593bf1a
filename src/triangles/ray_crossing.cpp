// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/ray_crossing.h"

#include <algorithm>

namespace lodestone {

namespace {

/// On which side of the directed edge from a to b the point (p.x + e, p.y + e^2) lies, seen from above: the sign of
/// (b - a) x (p - a) + (b.x - a.x) e^2 - (b.y - a.y) e. Zero only for a vertical edge; opposite for the edge from b to
/// a.
CGAL::Sign side(const Point& a, const Point& b, const Point& p) {
  using Point_2 = Kernel::Point_2;
  const auto sign = CGAL::orientation(Point_2(a.x(), a.y()), Point_2(b.x(), b.y()), Point_2(p.x(), p.y()));
  if (sign != CGAL::ZERO) return sign;
  if (const auto rise = CGAL::compare(a.y(), b.y()); rise != CGAL::EQUAL) return rise;
  return CGAL::compare(b.x(), a.x());
}

/// Whether the ray from (p.x + e, p.y + e^2, p.z) could cross the triangle, judged by its bounds alone.
bool within_reach(const Triangle& t, const Point& p) {
  const auto [min_x, max_x] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
  if (p.x() < min_x || p.x() >= max_x) return false;
  const auto [min_y, max_y] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
  return p.y() >= min_y && p.y() < max_y && p.z() <= std::max({t[0].z(), t[1].z(), t[2].z()});
}

}  // namespace

bool crosses_upward_ray(const Triangle& t, const Point& p) {
  if (!within_reach(t, p)) return false;
  const auto turn = side(t[0], t[1], p);
  if (turn == CGAL::ZERO || side(t[1], t[2], p) != turn || side(t[2], t[0], p) != turn) return false;
  // `turn` is the sense of the corners seen from above, so p is below their plane if it has the opposite orientation.
  // If p is in the plane, it is on the triangle.
  return CGAL::orientation(t[0], t[1], t[2], p) == -turn;
}

}  // namespace lodestone
