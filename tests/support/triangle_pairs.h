// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle pairs whose distance is hard to compute.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "lodestone/triangles/triangle_intersection.h"
#include "support/random_triangles.h"

namespace lodestone {

inline Triangle moved(Triangle t, double scale, const Point& offset) {
  for (auto& corner : t) corner = plus(offset, corner, scale);
  return t;
}

inline Triangle scaled(const Triangle& t, double factor) { return moved(t, factor, {0, 0, 0}); }

/// Pairs of many kinds, in the cube [0, 1]^3 or not far from it.
class Triangle_pairs : Random_triangles {
 public:
  explicit Triangle_pairs(std::uint64_t seed) : Random_triangles(seed) {}

  struct Kind {
    const char* name;
    Triangle_pair (Triangle_pairs::*make)();
  };
  static const std::vector<Kind> kinds;

 private:
  /// From 10^-14 to 1.
  double small() { return std::pow(10, -14 * uniform()); }
  Triangle sliver() {
    const Point p = point(), q = point(), along = plus(q, p, -1);
    return {p, q, plus(plus(p, along, 2 * uniform()), point(), small())};
  }

  Triangle_pair far_apart() { return {triangle(), moved(triangle(), 1, {1000 * uniform(), 1000 * uniform(), 2000})}; }
  Triangle_pair nearly_parallel() {
    const Triangle a = triangle();
    Triangle b = moved(a, 1 + uniform(), plus(point(), point(), -1));
    for (auto& corner : b) corner = plus(corner, point(), small());
    return {a, b};
  }
  Triangle_pair slivers() { return {sliver(), sliver()}; }
  Triangle_pair sliver_near_its_like() {
    const Triangle a = sliver();
    return {a, {plus(a[0], point(), small()), plus(a[1], point(), small()), plus(a[2], point(), small())}};
  }
  Triangle_pair just_above() {
    const Triangle a = triangle();
    const Point on = plus(plus(a[0], plus(a[1], a[0], -1), 0.3), plus(a[2], a[0], -1), 0.3);
    return {a, {plus(on, point(), small()), plus(on, point(), 1), plus(on, point(), 1)}};
  }
  Triangle_pair edges_just_apart() {
    const Triangle a = triangle();
    const Point on = plus(a[0], plus(a[1], a[0], -1), uniform()), away = plus(point(), point(), -1);
    const Point start = plus(plus(on, point(), small()), away, uniform());
    return {a, {start, plus(start, away, -1 - uniform()), plus(start, point(), 3)}};
  }
  Triangle_pair coplanar() {
    const Point u = point(), v = point();
    const auto flat = [&] { return plus(moved({u, u, u}, uniform(), {0, 0, 0})[0], v, 2 * uniform()); };
    return {{flat(), flat(), flat()}, moved({flat(), flat(), flat()}, 1, {uniform(), 0, 0})};
  }
  Triangle_pair of_grids_apart() {
    const auto cell = [&](double z) {
      const double x = static_cast<double>(random_() % 3), y = static_cast<double>(random_() % 3);
      const auto turned = [&](double i, double j) {
        return Point(0.6 * (x + i) - 0.8 * z, 0.8 * (x + i) + 0.6 * z, 0.3 * (x + i) + y + j);
      };
      return random_() % 2 == 0 ? Triangle{turned(0, 0), turned(1, 0), turned(1, 1)}
                                : Triangle{turned(0, 0), turned(1, 1), turned(0, 1)};
    };
    return {cell(0), cell(small())};
  }
  Triangle_pair segments_and_points() { return collapsed(random_() % 2 == 0 ? on_a_lattice() : nearly_parallel()); }
  Triangle_pair of_unlike_size() {
    const Triangle a = triangle();
    return {a, moved(triangle(), small(), plus(a[random_() % 3], point(), small()))};
  }
  Triangle_pair off_the_origin() {
    const auto [a, b] = random_() % 2 == 0 ? just_above() : nearly_parallel();
    return {moved(a, 0.01, {0x1p20, 0x1p20, -0x1p20}), moved(b, 0.01, {0x1p20, 0x1p20, -0x1p20})};
  }
};

inline const std::vector<Triangle_pairs::Kind> Triangle_pairs::kinds{
    {"anywhere", &Triangle_pairs::anywhere},
    {"far apart", &Triangle_pairs::far_apart},
    {"nearly parallel", &Triangle_pairs::nearly_parallel},
    {"slivers", &Triangle_pairs::slivers},
    {"sliver near its like", &Triangle_pairs::sliver_near_its_like},
    {"just above", &Triangle_pairs::just_above},
    {"edges just apart", &Triangle_pairs::edges_just_apart},
    {"coplanar", &Triangle_pairs::coplanar},
    {"of grids apart", &Triangle_pairs::of_grids_apart},
    {"touching", &Triangle_pairs::touching},
    {"on a lattice", &Triangle_pairs::on_a_lattice},
    {"segments and points", &Triangle_pairs::segments_and_points},
    {"of unlike size", &Triangle_pairs::of_unlike_size},
    {"off the origin", &Triangle_pairs::off_the_origin},
};

}  // namespace lodestone
