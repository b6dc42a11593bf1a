// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/triangle_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "support/touching_triangles.h"

namespace lodestone {
namespace {

bool intersect(const Integer_triangle& a, const Integer_triangle& b, double scale = 1, double offset = 0) {
  return triangles_intersect(as_triangle(a, scale, offset), as_triangle(b, scale, offset));
}

const Integer_triangle base{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

struct Known_case {
  const char* name;
  Integer_triangle a, b;
  bool meets;
};

const std::vector<Known_case> known_cases{
    {"apart", base, {{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}}, false},
    {"crossing", base, {{{1, 1, -1}, {1, 1, 1}, {5, 5, 1}}}, true},
    {"passing beside", base, {{{3, 3, -1}, {3, 3, 1}, {5, 5, 1}}}, false},
    {"corner on face", base, {{{1, 1, 0}, {1, 1, 1}, {2, 1, 1}}}, true},
    {"corner on edge", base, {{{2, 2, 0}, {2, 2, 1}, {3, 2, 1}}}, true},
    {"corner just beyond the edge", base, {{{2, 3, 0}, {2, 3, 1}, {3, 3, 1}}}, false},
    {"edge on face", base, {{{1, 1, 0}, {2, 1, 0}, {1, 1, 3}}}, true},
    {"edges crossing", base, {{{2, -1, 0}, {2, 1, 0}, {2, 0, 5}}}, true},
    {"edges crossing in a point", base, {{{2, 0, -1}, {2, 0, 1}, {2, -5, 0}}}, true},
    {"one common vertex", base, {{{0, 0, 0}, {-1, 0, 1}, {0, -1, 1}}}, true},
    {"common edge", base, {{{0, 0, 0}, {4, 0, 0}, {0, 0, 4}}}, true},
    {"the same", base, base, true},
    {"turned around", base, {{{0, 4, 0}, {4, 0, 0}, {0, 0, 0}}}, true},
    {"coplanar overlapping", base, {{{1, 1, 0}, {5, 1, 0}, {1, 5, 0}}}, true},
    {"coplanar within", base, {{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}, true},
    {"coplanar touching at an edge", base, {{{4, 0, 0}, {0, 4, 0}, {4, 4, 0}}}, true},
    {"coplanar touching at a corner", base, {{{4, 0, 0}, {5, 0, 0}, {5, 1, 0}}}, true},
    {"coplanar apart", base, {{{3, 3, 0}, {4, 3, 0}, {3, 4, 0}}}, false},
    {"segment through face", base, {{{1, 1, -1}, {1, 1, 1}, {1, 1, 3}}}, true},
    {"segment whose middle corner lies outside its ends", base, {{{1, 1, 2}, {1, 1, 3}, {1, 1, -1}}}, true},
    {"segment with two equal corners", base, {{{1, 1, -1}, {1, 1, -1}, {1, 1, 1}}}, true},
    {"segment short of face", base, {{{1, 1, 1}, {1, 1, 2}, {1, 1, 3}}}, false},
    {"segment in the plane, crossing", base, {{{-1, 1, 0}, {0, 1, 0}, {9, 1, 0}}}, true},
    {"segment in the plane, beside", base, {{{3, 3, 0}, {4, 3, 0}, {9, 3, 0}}}, false},
    {"segment on an edge", base, {{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}, true},
    {"point on face", base, {{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}}, true},
    {"point at a corner", base, {{{0, 4, 0}, {0, 4, 0}, {0, 4, 0}}}, true},
    {"point above face", base, {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, false},
    {"point beside face", base, {{{3, 3, 0}, {3, 3, 0}, {3, 3, 0}}}, false},
    {"two segments crossing", {{{0, 0, 0}, {2, 2, 0}, {4, 4, 0}}}, {{{0, 4, 0}, {4, 0, 0}, {1, 3, 0}}}, true},
    {"two segments passing", {{{0, 0, 0}, {2, 2, 0}, {4, 4, 0}}}, {{{0, 4, 1}, {4, 0, 1}, {1, 3, 1}}}, false},
    {"collinear segments overlapping", {{{0, 0, 0}, {2, 2, 2}, {4, 4, 4}}}, {{{3, 3, 3}, {9, 9, 9}, {5, 5, 5}}}, true},
    {"collinear segments touching", {{{0, 0, 0}, {2, 2, 2}, {4, 4, 4}}}, {{{4, 4, 4}, {9, 9, 9}, {5, 5, 5}}}, true},
    {"collinear segments apart", {{{0, 0, 0}, {2, 2, 2}, {4, 4, 4}}}, {{{6, 6, 6}, {9, 9, 9}, {5, 5, 5}}}, false},
    {"parallel segments", {{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}}, {{{0, 1, 0}, {2, 1, 0}, {4, 1, 0}}}, false},
    {"point on segment", {{{0, 0, 0}, {2, 2, 2}, {4, 4, 4}}}, {{{3, 3, 3}, {3, 3, 3}, {3, 3, 3}}}, true},
    {"point beyond segment", {{{0, 0, 0}, {2, 2, 2}, {4, 4, 4}}}, {{{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}}, false},
    {"equal points", {{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}, {{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}, true},
    {"different points", {{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}, {{{1, 2, 4}, {1, 2, 4}, {1, 2, 4}}}, false},
};

TEST(Oracle, is_right_in_the_known_cases) {
  for (const auto& c : known_cases) {
    EXPECT_EQ(have_common_point(c.a, c.b), c.meets) << c.name;
    EXPECT_EQ(have_common_point(c.b, c.a), c.meets) << c.name;
  }
}

/// The corners of a triangle where they may be read.
class Coordinates_of {
 public:
  explicit Coordinates_of(const Triangle& triangle) {
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) coordinates_[corner][axis] = triangle[corner][axis];
  }
  Triangle_corners of() const { return {coordinates_[0], coordinates_[1], coordinates_[2]}; }

 private:
  double coordinates_[3][3];
};

TEST(Triangles_intersect, is_right_in_the_known_cases_for_any_guess) {
  for (const auto& c : known_cases)
    for (const double scale : {1.0, 0x1p-300, 0x1p300, 0x1p-1072, 0x1p995, 0x1p1018})
      for (Crossing guess = 0; guess <= no_crossing; ++guess) {
        const Triangle a = as_triangle(c.a, scale), b = as_triangle(c.b, scale);
        const Coordinates_of corners_a(a), corners_b(b);
        EXPECT_EQ(triangles_intersect_given(corners_a.of(), corners_b.of(), guess), c.meets)
            << c.name << ' ' << scale << ' ' << int{guess};
        EXPECT_EQ(triangles_intersect_given(corners_b.of(), corners_a.of(), guess), c.meets)
            << c.name << ' ' << scale << ' ' << int{guess};
      }
}

TEST(Triangles_intersect, is_right_in_the_known_cases_at_any_scale_position_and_order_of_corners) {
  for (const auto& c : known_cases) {
    Integer_triangle a = c.a, b = c.b;
    std::ranges::sort(a);
    do {
      std::ranges::sort(b);
      do
        for (const auto& [scale, offset] :
             {std::pair{1.0, 0.0}, {0x1p-300, 0.0}, {0x1p300, 0.0}, {0x1p-1072, 0.0}, {0x1p1018, 0.0}, {1.0, 0x1p20}}) {
          EXPECT_EQ(intersect(a, b, scale, offset), c.meets) << c.name << " at " << scale;
          EXPECT_EQ(intersect(b, a, scale, offset), c.meets) << c.name << " at " << scale;
        }
      while (std::ranges::next_permutation(b).found);
    } while (std::ranges::next_permutation(a).found);
  }
}

TEST(Triangles_intersect, equals_the_oracle_on_small_integers_where_most_pairs_are_degenerate) {
  std::mt19937_64 random(1);
  std::size_t met = 0, degenerate = 0;
  for (int trial = 0; trial < 150000; ++trial) {
    const int size = 2 + trial % 4;
    const auto a = random_triangle(random, size), b = random_triangle(random, size);
    const bool expected = have_common_point(a, b);
    met += expected ? 1 : 0;
    degenerate += is_degenerate(a) || is_degenerate(b) ? 1 : 0;
    ASSERT_EQ(intersect(a, b), expected) << text(a) << " and " << text(b);
  }
  EXPECT_GT(met, 20000U);
  EXPECT_LT(met, 130000U);
  EXPECT_GT(degenerate, 10000U);
}

TEST(Triangles_intersect, equals_the_oracle_in_the_plane) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 60000; ++trial) {
    auto a = random_triangle(random, 5), b = random_triangle(random, 5);
    for (auto* triangle : {&a, &b})
      for (auto& corner : *triangle) corner[2] = corner[0] + 2 * corner[1];
    ASSERT_EQ(intersect(a, b), have_common_point(a, b)) << text(a) << " and " << text(b);
  }
}

TEST(Triangles_intersect, equals_the_oracle_where_one_last_digit_decides) {
  std::mt19937_64 random(3);
  std::size_t met = 0;
  for (int trial = 0; trial < 60000; ++trial) {
    const auto [a, b] = nearly_touching(random);
    const bool expected = have_common_point(a, b);
    met += expected ? 1 : 0;
    ASSERT_EQ(intersect(a, b), expected) << text(a) << " and " << text(b);
    ASSERT_EQ(intersect(b, a, 0x1p-300), expected) << text(a) << " and " << text(b);
  }
  EXPECT_GT(met, 15000U);
  EXPECT_LT(met, 55000U);
}

TEST(Triangles_intersect, equals_the_oracle_where_corners_are_collinear_up_to_rounding) {
  std::mt19937_64 random(6);
  std::size_t met = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const auto [a, b] = nearly_touching_a_segment(random);
    const bool expected = have_common_point(a, b);
    met += expected ? 1 : 0;
    for (const double scale : {1.0, 0x1p-560}) {
      ASSERT_EQ(intersect(a, b, scale), expected) << text(a) << " and " << text(b);
      ASSERT_EQ(intersect(b, a, scale), expected) << text(a) << " and " << text(b);
    }
  }
  EXPECT_GT(met, 4000U);
  EXPECT_LT(met, 16000U);
}

TEST(Triangles_intersect, equals_the_oracle_far_from_the_origin_and_at_extreme_scales) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 30000; ++trial) {
    const auto a = random_triangle(random, 4), b = random_triangle(random, 4);
    const bool expected = have_common_point(a, b);
    ASSERT_EQ(intersect(a, b, 0x1p-300), expected) << text(a) << " and " << text(b);
    ASSERT_EQ(intersect(a, b, 0x1p300), expected) << text(a) << " and " << text(b);
    ASSERT_EQ(intersect(a, b, 1, 0x1p20), expected) << text(a) << " and " << text(b);
    ASSERT_EQ(intersect(a, b, 0x1p-20, 0x1p20), expected) << text(a) << " and " << text(b);
  }
}

/// Distance of a point from a triangle of any shape, accurate to some roundings.
double distance(const Point& p, const Triangle& t) {
  double least = 1e300;
  for (int i = 0; i < 3; ++i) {
    const auto along = t[(i + 1) % 3] - t[i];
    const double length = along.squared_length();
    const double s = length > 0 ? std::clamp((p - t[i]) * along / length, 0.0, 1.0) : 0;
    least = std::min(least, std::sqrt((p - (t[i] + s * along)).squared_length()));
  }
  const auto normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  if (normal.squared_length() == 0) return least;
  bool within = true;
  for (int i = 0; i < 3; ++i) within &= CGAL::cross_product(t[(i + 1) % 3] - t[i], p - t[i]) * normal >= 0;
  return within ? std::min(least, std::abs((p - t[0]) * normal) / std::sqrt(normal.squared_length())) : least;
}

TEST(Triangle_intersection, has_points_on_both_triangles_and_none_if_they_are_apart) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 15000; ++trial) {
    const int size = 2 + trial % 4;
    auto ia = random_triangle(random, size), ib = random_triangle(random, size);
    if (trial % 3 == 0)
      for (auto* triangle : {&ia, &ib})
        for (auto& corner : *triangle) corner[2] = 1;
    const auto a = as_triangle(ia), b = as_triangle(ib);
    const auto points = triangle_intersection(a, b);
    ASSERT_EQ(!points.empty(), have_common_point(ia, ib)) << text(ia) << " and " << text(ib);
    for (const auto& p : points) {
      ASSERT_LT(distance(p, a), 1e-14) << text(ia) << " and " << text(ib);
      ASSERT_LT(distance(p, b), 1e-14) << text(ia) << " and " << text(ib);
    }
  }
}

TEST(Triangle_intersection, of_a_crossing_is_the_segment_in_both) {
  // The plane x = 1 cuts the first triangle from y = 0 to 3, the second along z = 0 from y = 1 to 5.
  const Triangle a = as_triangle(base), b{Point(1, 1, 0), Point(1, 5, -1), Point(1, 5, 1)};
  auto points = triangle_intersection(a, b);
  std::ranges::sort(points);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0], Point(1, 1, 0));
  EXPECT_EQ(points[1], Point(1, 3, 0));
}

TEST(Triangle_intersection, of_a_touch_is_a_point) {
  const auto points = triangle_intersection(as_triangle(base), as_triangle({{{1, 1, 0}, {1, 1, 1}, {2, 1, 1}}}));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0], Point(1, 1, 0));
}

TEST(Triangle_intersection, of_coplanar_triangles_is_the_polygon_in_both) {
  // Two triangles as in a star of six points.
  const auto star = triangle_intersection(as_triangle({{{0, 6, 0}, {-6, -3, 0}, {6, -3, 0}}}),
                                          as_triangle({{{0, -6, 0}, {6, 3, 0}, {-6, 3, 0}}}));
  std::vector<Point> corners(star.begin(), star.end());
  std::ranges::sort(corners);
  EXPECT_EQ(corners, (std::vector<Point>{{-4, 0, 0}, {-2, -3, 0}, {-2, 3, 0}, {2, -3, 0}, {2, 3, 0}, {4, 0, 0}}));
  const auto inner = triangle_intersection(as_triangle(base), as_triangle({{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}));
  EXPECT_EQ(inner.size(), 3U);
  const auto edge = triangle_intersection(as_triangle(base), as_triangle({{{4, 0, 0}, {0, 4, 0}, {4, 4, 0}}}));
  EXPECT_EQ(edge.size(), 2U);
}

TEST(Triangle_intersection, is_rounded_to_a_neighbouring_double) {
  // The edge from (0, 0, -1) to (1, 1, 2) meets the plane z = 0 at a third of the way.
  const Triangle a{Point(-5, -5, 0), Point(5, -5, 0), Point(0, 9, 0)};
  const auto points = triangle_intersection(a, {Point(0, 0, -1), Point(1, 1, 2), Point(0, 0, -1)});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].x(), 1 / 3.0, 0x1p-54);
  EXPECT_NEAR(points[0].y(), 1 / 3.0, 0x1p-54);
  EXPECT_EQ(points[0].z(), 0);
}

}  // namespace
}  // namespace lodestone
