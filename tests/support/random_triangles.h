// SPDX-License-Identifier: GPL-3.0-or-later
// What makers of triangle pairs share.
#pragma once

#include <cstdint>
#include <random>

#include "support/touching_triangles.h"

namespace lodestone {

inline Point plus(const Point& p, const Point& q, double factor) {
  return {p.x() + factor * q.x(), p.y() + factor * q.y(), p.z() + factor * q.z()};
}

/// Points, triangles and pairs of triangles in the cube [0, 1]^3.
class Random_triangles {
 protected:
  explicit Random_triangles(std::uint64_t seed) : random_(seed) {}

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Point point() {
    const double x = uniform(), y = uniform(), z = uniform();
    return {x, y, z};
  }
  Triangle triangle() { return {point(), point(), point()}; }

  Triangle_pair anywhere() { return {triangle(), triangle()}; }
  Triangle_pair touching() {
    const auto [a, b] = nearly_touching(random_);
    return {as_triangle(a, 0x1p-23), as_triangle(b, 0x1p-23)};
  }
  Triangle_pair on_a_lattice() {
    const int size = 2 + static_cast<int>(random_() % 6);
    const auto a = random_triangle(random_, size), b = random_triangle(random_, size);
    return {as_triangle(a, 0.125), as_triangle(b, 0.125)};
  }
  /// The triangles of a pair become segments and points.
  Triangle_pair collapsed(Triangle_pair pair) {
    auto& [a, b] = pair;
    a[1] = a[0];
    if (random_() % 2 == 0) a[2] = a[0];
    if (random_() % 2 == 0) b[2] = b[random_() % 2];
    return pair;
  }

  std::mt19937_64 random_;
};

}  // namespace lodestone
