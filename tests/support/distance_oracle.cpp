// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/distance_oracle.h"

namespace lodestone {

Rational exact_squared_distance(const Triangle& a, const Triangle& b) {
  if (triangles_intersect(a, b)) return 0;
  std::vector<Rational_vector> d;
  for (const auto& p : a)
    for (const auto& q : b)
      d.push_back(
          {Rational(p.x()) - Rational(q.x()), Rational(p.y()) - Rational(q.y()), Rational(p.z()) - Rational(q.z())});
  Rational least = dot(d[0], d[0]);
  const auto offer = [&](const Rational& squared) {
    if (squared < least) least = squared;
  };
  for (std::size_t i = 0; i < d.size(); ++i) {
    const auto& p = d[i];
    offer(dot(p, p));
    for (std::size_t j = 0; j < i; ++j) {
      const auto& q = d[j];
      const auto along = minus(q, p);
      const Rational foot = -dot(p, along), length = dot(along, along);
      if (foot > 0 && foot < length) offer(dot(p, p) - foot * foot / length);
      for (std::size_t k = 0; k < j; ++k) {
        const auto& r = d[k];
        const auto normal = cross(along, minus(r, p));
        if (dot(normal, cross(p, q)) > 0 && dot(normal, cross(q, r)) > 0 && dot(normal, cross(r, p)) > 0)
          offer(dot(normal, p) * dot(normal, p) / dot(normal, normal));
      }
    }
  }
  return least;
}

}  // namespace lodestone
