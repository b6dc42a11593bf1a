// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/triangle_intersection.h"

#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/exact_point.h"
#include "support/instruction_sets.h"
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

/// The corners of the intersection of two triangles that have an area, in rational numbers.
std::vector<Exact_point> exact_corners(const Triangle& a, const Triangle& b) {
  using Exact_kernel = CGAL::Simple_cartesian<Rational>;
  const auto exact = [](const Triangle& t) {
    return Exact_kernel::Triangle_3(exact_point(t[0]), exact_point(t[1]), exact_point(t[2]));
  };
  const auto shape = CGAL::intersection(exact(a), exact(b));
  if (!shape) return {};
  if (const auto* point = boost::get<Exact_point>(&*shape)) return {*point};
  if (const auto* segment = boost::get<Exact_kernel::Segment_3>(&*shape)) return {segment->source(), segment->target()};
  if (const auto* triangle = boost::get<Exact_kernel::Triangle_3>(&*shape))
    return {triangle->vertex(0), triangle->vertex(1), triangle->vertex(2)};
  return boost::get<std::vector<Exact_point>>(*shape);
}

bool is_nearest(double rounded, const Rational& exact) {
  const auto error = [&](double x) { return CGAL::abs(Rational(exact - Rational(x))); };
  const double infinity = std::numeric_limits<double>::infinity();
  return error(rounded) <= error(std::nextafter(rounded, -infinity)) &&
         error(rounded) <= error(std::nextafter(rounded, infinity));
}

/// The corners as sets: each computed one is nearest to an exact one, and the reverse.
bool are_nearest(const Intersection_points& points, const std::vector<Exact_point>& exact) {
  const auto match = [](const Point& p, const Exact_point& q) {
    return is_nearest(p.x(), q.x()) && is_nearest(p.y(), q.y()) && is_nearest(p.z(), q.z());
  };
  return std::ranges::all_of(
             points,
             [&](const Point& p) { return std::ranges::any_of(exact, [&](auto& q) { return match(p, q); }); }) &&
         std::ranges::all_of(
             exact, [&](auto& q) { return std::ranges::any_of(points, [&](const Point& p) { return match(p, q); }); });
}

/// A triangle with corners in a box of the given sizes around a point.
Triangle triangle_in_box(std::mt19937_64& random, const std::array<double, 3>& sizes, const Point& centre) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto corner = [&] {
    return Point(centre.x() + sizes[0] * unit(random), centre.y() + sizes[1] * unit(random),
                 centre.z() + sizes[2] * unit(random));
  };
  return {corner(), corner(), corner()};
}

TEST(Triangle_intersection, has_the_nearest_doubles_to_the_exact_corners) {
  struct Case {
    const char* name;
    std::array<double, 3> sizes_a, sizes_b;
    Point centre;
  };
  const std::vector<Case> cases{
      {"of like size", {1, 1, 1}, {1, 1, 1}, Point(0, 0, 0)},
      {"far from the origin", {1, 1, 1}, {1, 1, 1}, Point(1e6, -3e3, 7)},
      {"nearly parallel", {1, 1, 1e-9}, {1, 1, 1e-9}, Point(0, 0, 1)},
      {"nearly parallel, in a plane but for the last digits", {1, 1, 1e-15}, {1, 1, 1e-15}, Point(0, 0, 1)},
      {"one flat along an axis", {1, 1, 0}, {1, 1, 1}, Point(0.1, 0.2, 0)},
      {"one much smaller", {1e5, 1e5, 0.5}, {1, 1, 1}, Point(0, 0, 0)},
      {"thin", {1, 1e-12, 1e-6}, {1e-12, 1, 1e-6}, Point(0, 0, 0)},
      {"tiny", {0x1p-400, 0x1p-400, 0x1p-400}, {0x1p-400, 0x1p-400, 0x1p-400}, Point(0, 0, 0)},
      {"subnormal", {0x1p-1060, 0x1p-1060, 0x1p-1060}, {0x1p-1060, 0x1p-1060, 0x1p-1060}, Point(0, 0, 0)},
      {"huge", {0x1p900, 0x1p900, 0x1p900}, {0x1p900, 0x1p900, 0x1p900}, Point(0, 0, 0)},
      {"tiny across huge", {0x1p260, 0x1p260, 0}, {0x1p-260, 0x1p-260, 0x1p-260}, Point(0, 0, 0)},
  };
  std::mt19937_64 random(8);
  for (const auto& c : cases) {
    std::size_t found = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Triangle a = triangle_in_box(random, c.sizes_a, c.centre), b = triangle_in_box(random, c.sizes_b, c.centre);
      if (CGAL::collinear(a[0], a[1], a[2]) || CGAL::collinear(b[0], b[1], b[2])) continue;
      const auto exact = exact_corners(a, b);
      found += exact.empty() ? 0 : 1;
      const auto points = triangle_intersection(a, b);
      ASSERT_TRUE(are_nearest(points, exact)) << c.name << ", trial " << trial;
      ASSERT_EQ(points, triangle_intersection(b, a)) << c.name << ", trial " << trial;
    }
    EXPECT_GT(found, 0U) << c.name;
  }
}

TEST(Triangle_intersection, is_the_same_for_each_instruction_set) {
  std::mt19937_64 random(10);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto touching = [&] { return as_triangle(random_triangle(random, 4), 1 / 3.0); };
    const auto any = [&] { return triangle_in_box(random, {1, 1, 1}, Point(0, 0, 5)); };
    const Triangle a = trial % 2 == 0 ? any() : touching(), b = trial % 2 == 0 ? any() : touching();
    std::vector<Intersection_points> found;
    for_instruction_sets([&] { found.push_back(triangle_intersection(a, b)); });
    for (const auto& points : found) ASSERT_EQ(points, found[0]);
  }
}

TEST(Triangle_intersection, has_the_nearest_doubles_where_most_pairs_are_degenerate) {
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 5000; ++trial) {
    const auto ia = random_triangle(random, 2 + trial % 4), ib = random_triangle(random, 2 + trial % 4);
    if (is_degenerate(ia) || is_degenerate(ib)) continue;
    const auto a = as_triangle(ia, 1 / 3.0), b = as_triangle(ib, 1 / 3.0);
    ASSERT_TRUE(are_nearest(triangle_intersection(a, b), exact_corners(a, b))) << text(ia) << " and " << text(ib);
  }
}

TEST(Triangle_intersection, of_a_segment_has_its_ends_in_lexicographic_order_for_any_order_of_corners) {
  Triangle a = as_triangle(base), b{Point(1, 1, 0.25), Point(1, 5, -1), Point(1, 5, 1)};
  const auto expected = triangle_intersection(a, b);
  ASSERT_EQ(expected.size(), 2U);
  EXPECT_LT(expected[0], expected[1]);
  std::ranges::sort(a);
  do {
    std::ranges::sort(b);
    do EXPECT_EQ(triangle_intersection(a, b), expected);
    while (std::ranges::next_permutation(b).found);
  } while (std::ranges::next_permutation(a).found);
}

/// A random triangle that has an area, in the plane z = x + 2y.
Triangle triangle_in_plane(std::mt19937_64& random, int size, double scale) {
  for (;;) {
    auto triangle = random_triangle(random, size);
    for (auto& corner : triangle) corner[2] = corner[0] + 2 * corner[1];
    if (!is_degenerate(triangle)) return as_triangle(triangle, scale);
  }
}

TEST(Triangle_intersection, of_coplanar_triangles_goes_round_the_polygon_by_the_first_of_all_ways) {
  std::mt19937_64 random(11);
  std::array<int, 7> found{};
  for (int trial = 0; trial < 6000; ++trial) {
    const double scale = std::array{1.0, 0x1p-1060, 0x1p1000}[static_cast<std::size_t>(trial % 3)];
    const Triangle a = triangle_in_plane(random, 12, scale), b = triangle_in_plane(random, 12, scale);
    const auto points = triangle_intersection(a, b);
    ASSERT_EQ(points, triangle_intersection(b, a)) << "trial " << trial;
    // CGAL goes round too, from any corner in any direction.
    auto exact = exact_corners(a, b);
    ASSERT_EQ(points.size(), exact.size()) << "trial " << trial;
    ++found[points.size()];
    bool equals_a_way_round = exact.empty();
    for (int direction = 0; direction < 2; ++direction, std::ranges::reverse(exact))
      for (std::size_t start = 0; start < exact.size(); ++start) {
        std::ranges::rotate(exact, exact.begin() + 1);
        Intersection_points way;
        for (std::size_t i = 0; i < exact.size(); ++i) {
          const auto near = [&](double x, const Rational& y) { return is_nearest(x, y); };
          const Point& p = points[i];
          if (near(p.x(), exact[i].x()) && near(p.y(), exact[i].y()) && near(p.z(), exact[i].z())) way.push_back(p);
        }
        equals_a_way_round |= way.size() == exact.size();
      }
    ASSERT_TRUE(equals_a_way_round) << "trial " << trial;
    if (points.empty()) continue;
    ASSERT_EQ(*std::ranges::min_element(points), points.front());
    ASSERT_LE(points[points.size() > 1 ? 1 : 0], points.back());
  }
  EXPECT_GT(found[0], 500);
  for (std::size_t corners = 1; corners < found.size(); ++corners) EXPECT_GT(found[corners], 10) << corners;
}

TEST(Triangle_intersection, of_touching_triangles_is_the_same_for_any_order_of_corners_and_triangles) {
  std::mt19937_64 random(12);
  for (int trial = 0; trial < 300; ++trial) {
    Triangle a = as_triangle(random_triangle(random, 4), 1 / 3.0), b = as_triangle(random_triangle(random, 4), 1 / 3.0);
    const auto expected = triangle_intersection(a, b);
    std::ranges::sort(a);
    do {
      std::ranges::sort(b);
      do {
        ASSERT_EQ(triangle_intersection(a, b), expected) << "trial " << trial;
        ASSERT_EQ(triangle_intersection(b, a), expected) << "trial " << trial;
      } while (std::ranges::next_permutation(b).found);
    } while (std::ranges::next_permutation(a).found);
  }
}

TEST(Triangle_intersection, has_the_nearest_double_where_an_edge_is_subnormal_along_an_axis) {
  constexpr double least = std::numeric_limits<double>::denorm_min(), normal = 0x1p-1021;
  const Triangle face{Point(-1, -1, 0), Point(3, -1, 0), Point(-1, 3, 0)};
  const Triangle rising{Point(normal, 0, -11), Point(normal + 2 * least, 0, 9), Point(1, 0.5, 9)};
  const auto exact = exact_corners(face, rising);
  EXPECT_EQ(exact.size(), 2U);
  EXPECT_TRUE(are_nearest(triangle_intersection(face, rising), exact));
  EXPECT_EQ(triangle_intersection(face, rising), triangle_intersection(rising, face));
}

TEST(Triangle_intersection, has_no_negative_zero) {
  const Triangle a{Point(-0.0, -0.0, -0.0), Point(4, -0.0, -0.0), Point(-0.0, 4, -0.0)};
  const Triangle b{Point(-0.0, -0.0, -0.0), Point(-0.0, -0.0, 1), Point(-1, -1, 1)};
  for (const auto& points : {triangle_intersection(a, b), triangle_intersection(a, a)}) {
    ASSERT_FALSE(points.empty());
    for (const Point& p : points)
      for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(p[axis]));
  }
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

TEST(Segment_intersects, is_true_exactly_where_a_triangle_without_area_meets_the_other) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> number(-2, 2);
  int meeting = 0, points = 0;
  for (const double scale : {1.0, 0x1p-1060, 0x1p1000})
    for (int i = 0; i < 20000; ++i) {
      const auto point = [&] { return Point(scale * number(random), scale * number(random), scale * number(random)); };
      const Point p = point(), q = i % 8 == 0 ? p : point();
      const Triangle triangle{point(), point(), point()};
      const bool meets = triangles_intersect({p, q, q}, triangle);
      ASSERT_EQ(segment_intersects(p, q, triangle), meets) << p << ", " << q;
      ASSERT_EQ(segment_intersects(q, p, triangle), meets) << p << ", " << q;
      meeting += meets ? 1 : 0;
      points += meets && p == q ? 1 : 0;
    }
  EXPECT_GT(meeting, 5000);
  EXPECT_GT(points, 100);
}

}  // namespace
}  // namespace lodestone
