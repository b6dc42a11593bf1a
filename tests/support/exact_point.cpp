// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/exact_point.h"

namespace lodestone {

Exact_point exact_point(const double* p) { return {p[0], p[1], p[2]}; }

Exact_point exact_point(const Point& p) { return {p.x(), p.y(), p.z()}; }

Exact_point exact_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Exact_point nearest_point(const Exact_triangle& t, const Exact_point& c) {
  Exact_point best = t[0];
  const auto offer = [&](const Exact_point& p) {
    if ((p - c).squared_length() < (best - c).squared_length()) best = p;
  };
  for (int i = 0; i < 3; ++i) {
    const Exact_point &p = t[i], &q = t[(i + 1) % 3];
    const Exact_vector along = q - p;
    offer(p);
    if (along.squared_length() == 0) continue;
    const Rational foot = (c - p) * along / along.squared_length();
    if (foot > 0 && foot < 1) offer(p + foot * along);
  }
  const Exact_vector normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  if (normal.squared_length() == 0) return best;
  const Exact_point foot = c - ((c - t[0]) * normal / normal.squared_length()) * normal;
  for (int i = 0; i < 3; ++i)
    if (CGAL::cross_product(t[(i + 1) % 3] - t[i], foot - t[i]) * normal < 0) return best;
  return foot;
}

}  // namespace lodestone
