// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/touching_triangles.h"

namespace lodestone {

Wide determinant(const Wide_vector& p, const Wide_vector& q, const Wide_vector& r) { return dot(p, cross(q, r)); }

bool is_zero(const Wide_vector& p) { return p[0] == 0 && p[1] == 0 && p[2] == 0; }

bool same_sign(std::initializer_list<Wide> values) {
  bool above = true, below = true;
  for (const Wide value : values) {
    above &= value >= 0;
    below &= value <= 0;
  }
  return above || below;
}

bool origin_in(const Wide_vector& p, const Wide_vector& q) { return is_zero(cross(p, q)) && dot(p, q) <= 0; }

bool origin_in(const Wide_vector& p, const Wide_vector& q, const Wide_vector& r) {
  const Wide_vector normal = cross(minus(q, p), minus(r, p));
  return !is_zero(normal) && dot(normal, p) == 0 &&
         same_sign({dot(normal, cross(p, q)), dot(normal, cross(q, r)), dot(normal, cross(r, p))});
}

bool origin_in(const Wide_vector& p, const Wide_vector& q, const Wide_vector& r, const Wide_vector& s) {
  const Wide_vector a = minus(q, p), b = minus(r, p), c = minus(s, p);
  return determinant(a, b, c) != 0 &&
         same_sign({determinant(q, r, s), -determinant(p, r, s), determinant(p, q, s), -determinant(p, q, r)});
}

bool have_common_point(const Integer_triangle& a, const Integer_triangle& b) {
  std::vector<Wide_vector> d;
  for (const auto& p : a)
    for (const auto& q : b) d.push_back({Wide(p[0]) - q[0], Wide(p[1]) - q[1], Wide(p[2]) - q[2]});
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (is_zero(d[i])) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (origin_in(d[i], d[j])) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (origin_in(d[i], d[j], d[k])) return true;
        for (std::size_t l = 0; l < k; ++l)
          if (origin_in(d[i], d[j], d[k], d[l])) return true;
      }
    }
  }
  return false;
}

bool is_degenerate(const Integer_triangle& t) {
  const auto wide = [](const Integer_point& p) { return Wide_vector{p[0], p[1], p[2]}; };
  return is_zero(cross(minus(wide(t[1]), wide(t[0])), minus(wide(t[2]), wide(t[0]))));
}

Triangle as_triangle(const Integer_triangle& t, double scale, double offset) {
  const auto point = [&](const Integer_point& p) {
    const auto place = [&](int axis) { return scale * static_cast<double>(p[axis]) + offset; };
    return Point(place(0), place(1), place(2));
  };
  return {point(t[0]), point(t[1]), point(t[2])};
}

std::string text(const Integer_triangle& t) {
  std::ostringstream out;
  for (const auto& p : t) out << '(' << p[0] << ' ' << p[1] << ' ' << p[2] << ')';
  return out.str();
}

Integer_triangle random_triangle(std::mt19937_64& random, int size) {
  Integer_triangle t{};
  for (auto& corner : t)
    for (auto& x : corner) x = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(size));
  return t;
}

std::pair<Integer_triangle, Integer_triangle> nearly_touching(std::mt19937_64& random) {
  const auto a0 = random_triangle(random, 1 << 13);
  Integer_triangle a{};
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis) a[i][axis] = a0[i][axis] * 1024;
  // Weights in 1024ths, often at an edge or a corner.
  const auto weight = [&](std::int64_t most) {
    const auto kind = random() % 4;
    return kind == 0   ? 0
           : kind == 1 ? most
                       : static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(most + 1));
  };
  const std::int64_t s = weight(1024), t = weight(1024 - s);
  Integer_triangle b{};
  for (int axis = 0; axis < 3; ++axis) b[0][axis] = a0[0][axis] * (1024 - s - t) + a0[1][axis] * s + a0[2][axis] * t;
  if (random() % 2 == 0) b[0][random() % 3] += random() % 2 == 0 ? 1 : -1;
  for (int i = 1; i < 3; ++i)
    for (auto& x : b[i]) x = static_cast<std::int64_t>(random() % (1U << 23));
  return {a, b};
}

std::pair<Integer_triangle, Integer_triangle> nearly_touching_a_segment(std::mt19937_64& random) {
  const auto below = [&](std::uint64_t limit) { return static_cast<std::int64_t>(random() % limit); };
  Integer_point start{}, along{};
  for (int axis = 0; axis < 3; ++axis) start[axis] = below(1 << 13), along[axis] = below(1 << 13);
  const auto on_line = [&](std::int64_t steps) {
    return Integer_point{start[0] + steps * along[0], start[1] + steps * along[1], start[2] + steps * along[2]};
  };
  const Integer_triangle a{on_line(below(1 << 14)), on_line(below(1 << 14)), on_line(below(1 << 14))};
  Integer_triangle b{on_line(below(1 << 14)), {}, {}};
  if (random() % 3 == 0) b[0][random() % 3] += 1;
  for (int i = 1; i < 3; ++i)
    for (auto& x : b[i]) x = below(1 << 27);
  if (random() % 3 == 0) b[1] = on_line(below(1 << 14)), b[2] = on_line(below(1 << 14));
  return {a, b};
}

}  // namespace lodestone
