// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of triangles that are hard to decide.
#pragma once

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "support/random_triangles.h"

namespace lodestone {

/// Pairs of many kinds in the cube [0, 1]^3, or not far from it, which mostly touch, just miss each other or just meet.
class Hard_pairs : Random_triangles {
 public:
  explicit Hard_pairs(std::uint64_t seed) : Random_triangles(seed) {}

  struct Kind {
    const char* name;
    Triangle_pair (Hard_pairs::*make)();
  };
  static std::vector<Kind> kinds() {
    return {{"anywhere", &Hard_pairs::anywhere},
            {"touching", &Hard_pairs::touching},
            {"touching a segment", &Hard_pairs::touching_a_segment},
            {"coplanar up to rounding", &Hard_pairs::coplanar},
            {"on a lattice", &Hard_pairs::on_a_lattice},
            {"slivers", &Hard_pairs::slivers},
            {"segments and points", &Hard_pairs::segments_and_points},
            {"with corners in common", &Hard_pairs::with_corners_in_common},
            {"just apart", &Hard_pairs::just_apart},
            {"of unlike size", &Hard_pairs::of_unlike_size}};
  }

 private:
  /// 0, or from 10^-17 to 1; of either sign.
  double small() { return random_() % 4 == 0 ? 0 : (random_() % 2 == 0 ? 1 : -1) * std::pow(10, -17 * uniform()); }
  static Point between(const Point& p, const Point& q, double t) { return plus(plus(p, p, -t), q, t); }
  Point beside(const Point& p) { return {p.x() + small(), p.y() + small(), p.z() + small()}; }
  /// A point of the triangle up to rounding, often on an edge or a corner.
  Point on(const Triangle& t) {
    const double u = random_() % 3 == 0 ? 0 : uniform(), v = random_() % 3 == 0 ? 0 : uniform();
    return between(between(t[0], t[1], u), t[2], v);
  }

  Triangle_pair touching_a_segment() {
    const auto [a, b] = nearly_touching_a_segment(random_);
    return {as_triangle(a, 0x1p-27), as_triangle(b, 0x1p-27)};
  }
  Triangle_pair coplanar() {
    const Point u = point(), v = point(), w = point();
    const auto flat = [&] { return plus(plus(u, v, 2 * uniform() - 1), w, 2 * uniform() - 1); };
    Triangle a{flat(), flat(), flat()}, b{flat(), flat(), flat()};
    if (random_() % 2 == 0) b[0] = on(a);
    return {a, b};
  }
  Triangle_pair slivers() {
    const auto sliver = [&](const Point& through) {
      const Point end = point();
      return Triangle{end, beside(between(end, through, 2 * uniform())), beside(between(end, through, 2 * uniform()))};
    };
    const Point through = point();
    return {sliver(through), sliver(through)};
  }
  Triangle_pair segments_and_points() { return collapsed(random_() % 2 == 0 ? on_a_lattice() : coplanar()); }
  Triangle_pair with_corners_in_common() {
    auto [a, b] = random_() % 2 == 0 ? anywhere() : coplanar();
    for (std::uint64_t common = 1 + random_() % 3; common-- > 0;) b[common] = a[random_() % 3];
    return {a, b};
  }
  Triangle_pair just_apart() {
    const Triangle a = triangle();
    const Point p = beside(on(a)), along = plus(point(), point(), -1);
    if (random_() % 2 == 0) return {a, {p, plus(p, point(), 1), plus(p, point(), 1)}};
    return {a, {plus(p, along, uniform()), plus(p, along, -uniform()), plus(p, point(), 3)}};  // edge by edge or face
  }
  Triangle_pair of_unlike_size() {
    const Triangle a = triangle();
    const Point p = on(a);
    return {a, {beside(p), beside(p), beside(p)}};
  }
};

}  // namespace lodestone
