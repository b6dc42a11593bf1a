// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of moving triangles whose first impact is hard to decide.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "lodestone/triangles/impact.h"

namespace lodestone {

struct Moving_pair {
  Moving_triangle a, b;
};

inline Moving_triangle standing(const Triangle& t) { return {t, t}; }

/// Takes every corner p, at the start and at the end, to `map(p)`.
template <class Map>
Moving_triangle mapped(Moving_triangle moving, Map map) {
  for (auto* triangle : {&moving.start, &moving.end})
    for (Point& p : *triangle) p = map(p);
  return moving;
}

/// Pairs whose corners have small integer coordinates. Many touch in corners or edges, move in one plane, begin to
/// overlap at a rational time, are segments or points, or become so.
class Moving_pairs {
 public:
  explicit Moving_pairs(std::uint64_t seed) : random_(seed) {}

  Moving_pair on_a_lattice() {
    size_ = 2 + static_cast<int>(random_() % 8);
    Moving_pair pair{{triangle(), triangle()}, {triangle(), triangle()}};
    const double aside = size_ - 1;
    if (random_() % 3 != 0) pair.b.start = beside(pair.b.start, aside);
    if (random_() % 4 == 0) pair.b.end = beside(pair.b.end, aside);
    if (random_() % 4 == 0) pair.a.end = pair.a.start;
    if (random_() % 6 == 0) join(pair.a, random_() % 3);
    if (random_() % 6 == 0) join(pair.b, random_() % 3);
    if (random_() % 8 == 0) join(pair.a, 0), join(pair.a, 1);
    if (random_() % 8 == 0) pair.b.end[1] = pair.b.end[0];
    if (random_() % 8 == 0) flatten(pair);
    return pair;
  }

  /// The same, with some coordinates off by 2^-50 to 2^-21: many just meet, or just miss each other.
  Moving_pair beside_a_lattice() {
    Moving_pair pair = on_a_lattice();
    const auto beside = [this](double x) {
      const auto factor = static_cast<double>(random_() % 5) - 2;
      return random_() % 2 == 0 ? x : x + std::ldexp(factor, -50 + static_cast<int>(random_() % 30));
    };
    for (auto* moving : {&pair.a, &pair.b})
      *moving = mapped(*moving, [&](const Point& p) {
        const double x = beside(p.x()), y = beside(p.y()), z = beside(p.z());
        return Point(x, y, z);
      });
    return pair;
  }

  /// Any coordinates in [0, 1], at first apart along x.
  Moving_pair anywhere() {
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto any = [&] {
      const auto point = [&] {
        const double x = uniform(random_), y = uniform(random_), z = uniform(random_);
        return Point(x, y, z);
      };
      return Triangle{point(), point(), point()};
    };
    Moving_pair pair{{any(), any()}, {beside(any(), 1), beside(any(), 1 - 2 * uniform(random_))}};
    return pair;
  }

 private:
  Point point() {
    const auto coordinate = [this] { return static_cast<double>(random_() % static_cast<std::uint64_t>(size_)); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }
  Triangle triangle() { return {point(), point(), point()}; }
  static Triangle beside(Triangle t, double distance) {
    for (Point& p : t) p = Point(p.x() + distance, p.y(), p.z());
    return t;
  }
  static void join(Moving_triangle& moving, std::size_t corner) {
    moving.start[(corner + 1) % 3] = moving.start[corner];
    moving.end[(corner + 1) % 3] = moving.end[corner];
  }
  /// All corners stay in one plane, which may move and turn.
  void flatten(Moving_pair& pair) {
    const double slope = static_cast<double>(random_() % 3), lift = static_cast<double>(random_() % 3);
    for (auto* moving : {&pair.a, &pair.b}) {
      for (Point& p : moving->start) p = Point(p.x(), p.y(), 0);
      for (Point& p : moving->end) p = Point(p.x(), p.y(), slope * p.x() + lift);
    }
  }

  std::mt19937_64 random_;
  int size_ = 2;
};

}  // namespace lodestone
