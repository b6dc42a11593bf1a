// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/triangle_distance.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "support/distance_oracle.h"
#include "support/hard_pairs.h"
#include "support/special_numbers.h"
#include "support/triangle_pairs.h"

namespace lodestone {
namespace {

/// Calls `check(a, b)` for pairs of all kinds.
template <class Check>
void for_pairs(int of_each_kind, const Check& check) {
  Triangle_pairs pairs(1);
  for (const auto& kind : Triangle_pairs::kinds)
    for (int trial = 0; trial < of_each_kind; ++trial) {
      const auto [a, b] = (pairs.*kind.make)();
      SCOPED_TRACE(std::string(kind.name) + ", trial " + std::to_string(trial));
      check(a, b);
      if (testing::Test::HasFatalFailure()) return;
    }
}

double greatest_coordinate(const Triangle& a, const Triangle& b) {
  double most = 0;
  for (const auto* t : {&a, &b})
    for (const auto& corner : *t)
      for (int axis = 0; axis < 3; ++axis) most = std::max(most, std::abs(corner[axis]));
  return most;
}

Rational square(double x) { return Rational(x) * Rational(x); }

TEST(Distance_oracle, equals_that_of_cgal_on_exact_numbers) {
  using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
  const auto exact = [](const Triangle& t) {
    const auto point = [](const Point& p) { return Epeck::Point_3(p.x(), p.y(), p.z()); };
    return Epeck::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
  };
  for_pairs(50, [&](const Triangle& a, const Triangle& b) {
    ASSERT_EQ(Rational(CGAL::exact(CGAL::squared_distance(exact(a), exact(b)))), exact_squared_distance(a, b));
  });
}

TEST(Closest_points, have_the_distance_of_the_triangles_up_to_a_relative_error_of_2_to_the_minus_30) {
  for_pairs(150, [](const Triangle& a, const Triangle& b) {
    const Rational expected = exact_squared_distance(a, b);
    for (const auto& found : {closest_points(a, b), closest_points(b, a)}) {
      // (1 + 2^-30)^2 < 1 + 2^-28.9
      const Rational error = square(found.distance) - expected, bound = expected * Rational(0x1.1p-29);
      ASSERT_TRUE(-bound <= error && error <= bound) << found.distance;
    }
  });
}

TEST(Closest_points, lie_on_the_triangles_at_the_reported_distance) {
  for_pairs(150, [](const Triangle& a, const Triangle& b) {
    const auto found = closest_points(a, b);
    const double digits = 0x1p-50 * greatest_coordinate(a, b);
    ASSERT_LE(exact_squared_distance({found.a, found.a, found.a}, a), square(digits));
    ASSERT_LE(exact_squared_distance({found.b, found.b, found.b}, b), square(digits));
    const double apart = std::hypot(found.a.x() - found.b.x(), found.a.y() - found.b.y(), found.a.z() - found.b.z());
    ASSERT_NEAR(apart, found.distance, 4 * digits + 0x1p-30 * found.distance);
  });
}

TEST(Closest_points, are_at_distance_zero_if_and_only_if_the_triangles_intersect) {
  std::size_t met = 0;
  for_pairs(1500, [&](const Triangle& a, const Triangle& b) {
    const bool meet = triangles_intersect(a, b);
    met += meet ? 1 : 0;
    const auto found = closest_points(a, b);
    ASSERT_EQ(found.distance == 0, meet);
    if (meet) {
      ASSERT_EQ(found.a, found.b);
    }
  });
  EXPECT_GT(met, 2000U);
}

TEST(Closest_points, have_the_distance_of_gaps_whose_squares_underflow) {
  for (const bool is_flat : {false, true})
    for (const int exponent : {-500, -522, -525, -530, -537, -600, -1000}) {
      const double gap = std::ldexp(1.18, exponent), z = is_flat ? gap : 1;
      const Triangle a{Point(0, 0, gap), Point(1, 0, z), Point(0, 1, z)},
          b{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
      EXPECT_NEAR(closest_points(a, b).distance / gap, 1, 0x1p-30) << exponent;
    }
}

TEST(Closest_points, have_the_distance_of_triangles_that_are_wider_than_the_greatest_double) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    const auto corner = [&](double x) {
      return Point(std::ldexp(x + 1e-9 * unit(random), 1023), std::ldexp(unit(random), 942),
                   std::ldexp(unit(random), 916));
    };
    const Triangle a{corner(-1.5), corner(1.5), corner(1.5)}, b{corner(1.5), corner(-1.5), corner(1.5)};
    const Rational squared = exact_squared_distance(a, b);
    const Rational distance(closest_points(a, b).distance);
    const Rational error(0x1p-28);
    EXPECT_LE(CGAL::abs(Rational(distance * distance - squared)), Rational(error * squared)) << trial;
  }
}

TEST(Closest_points, scale_with_powers_of_two) {
  for_pairs(100, [](const Triangle& a, const Triangle& b) {
    const auto found = closest_points(a, b);
    for (const double factor : {0x1p-300, 0x1p300, 0x1p-700, 0x1p1000}) {
      const auto other = closest_points(scaled(a, factor), scaled(b, factor));
      ASSERT_EQ(other.distance, factor * found.distance);
      ASSERT_EQ(other.a, scaled({found.a, found.a, found.a}, factor)[0]);
      ASSERT_EQ(other.b, scaled({found.b, found.b, found.b}, factor)[0]);
    }
  });
}

TEST(Closest_points, are_apart_even_if_their_distance_is_below_the_smallest_double) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const Triangle segment{Point(0, 0, 0), Point(0, 0, 0), Point(0x1p52, 1, 0)};
  const Triangle beside{Point(smallest, 0, 0), Point(smallest, 0, 0), Point(smallest, 0, 0)};
  EXPECT_EQ(closest_points(segment, beside).distance, smallest);
  EXPECT_TRUE(triangles_nearer_than(segment, beside, smallest));
  const Triangle next{Point(0, 0, smallest), Point(0, 0, smallest), Point(0, 0, smallest)};
  EXPECT_EQ(closest_points(segment, next).distance, smallest);
  EXPECT_FALSE(triangles_nearer_than(segment, next, smallest));
}

TEST(Closest_points, of_the_greatest_coordinates_are_finite) {
  constexpr double most = std::numeric_limits<double>::max();
  const Triangle low{Point(-most, 0, 0), Point(-most, 1, 0), Point(-most, 0, 1)};
  const Triangle high{Point(most / 2, 0, 0), Point(most / 2, 1, 0), Point(most, most, most)};
  const auto found = closest_points(low, high);
  EXPECT_EQ(found.distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found.a.x(), -most);
  EXPECT_EQ(found.b.x(), most / 2);
  EXPECT_FALSE(triangles_nearer_than(low, high, most));
  const Triangle middle{Point(0, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  EXPECT_EQ(closest_points(middle, low).distance, most);
}

TEST(Closest_points, beyond_half_the_greatest_double_are_finite) {
  const Point q(-1e308, -1, 5e-324);
  const Triangle wide{Point(1, -1, 0), Point(-1e308, -1e308, 8.988e307), Point(-1e308, 0, -1)}, corner{q, q, q};
  const auto found = closest_points(wide, corner);
  EXPECT_DOUBLE_EQ(found.a.x(), -1e308);
  EXPECT_NEAR(found.a.y(), -1.05, 0.01);
  EXPECT_NEAR(found.a.z(), -0.056, 0.01);
  EXPECT_EQ(found.b, q);
}

TEST(Closest_points, are_at_distance_zero_where_only_an_edge_is_longer_than_the_greatest_double) {
  // Found by fuzzing. No corner of one is so far from one of the other.
  constexpr double far = 0x1p1023;
  const Triangle high{Point(0, 1, 0.75 * far), Point(0, 0, -1.5 * far), Point(0, 0, -0.5 * far)};
  const Triangle touching{Point(0, 0, -far), Point(0, -1, 0), Point(0, -1, 0)};
  ASSERT_TRUE(triangles_intersect(high, touching));
  EXPECT_EQ(closest_points(high, touching).distance, 0);
  EXPECT_EQ(closest_points(touching, high).distance, 0);
}

TEST(Triangles_nearer_than, equals_the_oracle_to_the_last_digit) {
  for_pairs(60, [](const Triangle& a, const Triangle& b) {
    const Rational squared = exact_squared_distance(a, b);
    const double about = closest_points(a, b).distance;
    for (const double factor : {0.1, 0.9, 1 - 1e-7, 1 - 0x1p-40, 1 - 0x1p-51, 1 - 0x1p-53, 1.0, 1 + 0x1p-52,
                                1 + 0x1p-50, 1 + 0x1p-40, 1 + 1e-7, 1.1, 10.0}) {
      const double limit = about > 0 ? about * factor : factor * 1e-9;
      ASSERT_EQ(triangles_nearer_than(a, b, limit), squared < square(limit)) << limit;
      ASSERT_EQ(triangles_nearer_than(b, a, limit), squared < square(limit)) << limit;
      for (const double scale : {0x1p-300, 0x1p300})
        ASSERT_EQ(triangles_nearer_than(scaled(a, scale), scaled(b, scale), scale * limit), squared < square(limit))
            << limit << " at " << scale;
    }
  });
}

TEST(Triangles_nearer_than, equals_the_oracle_where_parallel_triangles_are_as_far_apart_as_the_limit) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double angle : {0.0, 0.3}) {
    int nearer = 0, apart = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const double limit = 0.1 * std::abs(unit(random)), height = 0.7 * unit(random);
      const double c = std::cos(angle), s = std::sin(angle);
      const auto triangle = [&](double z) {
        const auto corner = [&] {
          const double x = unit(random), y = unit(random);
          return Point(c * x - s * z, y, s * x + c * z);
        };
        return Triangle{corner(), corner(), corner()};
      };
      const Triangle a = triangle(height), b = trial % 2 == 0 ? triangle(height + limit) : triangle(height - limit);
      const bool expected = exact_squared_distance(a, b) < square(limit);
      ASSERT_EQ(triangles_nearer_than(a, b, limit), expected) << "angle " << angle << ", trial " << trial;
      ASSERT_EQ(triangles_nearer_than(b, a, limit), expected) << "angle " << angle << ", trial " << trial;
      ++(expected ? nearer : apart);
    }
    // Sums are rounded up and down.
    EXPECT_GT(nearer, 40) << angle;
    EXPECT_GT(apart, 40) << angle;
  }
}

struct Exactly_apart {
  const char* name;
  Integer_triangle a, b;
  int distance;
};

const Integer_triangle large_base{{{0, 0, 0}, {12, 0, 0}, {0, 12, 0}}};

const std::vector<Exactly_apart> exactly_apart{
    {"corner to corner", large_base, {{{-3, -4, 0}, {-9, -4, 0}, {-3, -9, 1}}}, 5},
    {"corner to corner in space", large_base, {{{-2, -3, 6}, {-3, -4, 9}, {-4, -3, 9}}}, 7},
    {"corner to edge", large_base, {{{5, -3, 4}, {4, -6, 8}, {6, -6, 8}}}, 5},
    {"corner to face", large_base, {{{3, 3, 5}, {2, 2, 9}, {4, 5, 9}}}, 5},
    {"edge to face", large_base, {{{2, 2, 5}, {4, 3, 5}, {4, 5, 9}}}, 5},
    {"parallel faces", large_base, {{{1, 1, 5}, {14, 1, 5}, {1, 14, 5}}}, 5},
    {"parallel edges", large_base, {{{1, -3, 4}, {9, -3, 4}, {4, -9, 9}}}, 5},
    {"crossing edges", large_base, {{{5, -7, 1}, {5, 1, 7}, {5, -7, 9}}}, 5},
    {"edges at right angles", {{{-9, 0, 0}, {9, 0, 0}, {0, 0, -9}}}, {{{0, -9, 5}, {0, 9, 5}, {0, 0, 9}}}, 5},
    {"coplanar", large_base, {{{-5, 1, 0}, {-5, 3, 0}, {-9, 2, 0}}}, 5},
    {"segments", {{{-9, 0, 0}, {9, 0, 0}, {1, 0, 0}}}, {{{1, -9, 5}, {1, 9, 5}, {1, 3, 5}}}, 5},
    {"points", {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, {{{1, 4, 5}, {1, 4, 5}, {1, 4, 5}}}, 5},
};

TEST(Corners_nearer_than, proves_only_what_is_true_at_any_scale) {
  Hard_pairs hard(5);
  std::size_t proven = 0, near = 0;
  for (const auto& kind : Hard_pairs::kinds())
    for (const double scale : {1.0, 0x1p-60, 0x1p200, 0x1p-600, 0x1p1000})
      for (int i = 0; i < 60; ++i) {
        auto [a, b] = (hard.*kind.make)();
        for (auto* triangle : {&a, &b})
          for (auto& p : *triangle) p = {scale * p.x(), scale * p.y(), scale * p.z()};
        const auto corners_of = [](const Triangle& t) {
          return Triangle_corners{&*t[0].cartesian_begin(), &*t[1].cartesian_begin(), &*t[2].cartesian_begin()};
        };
        const double gap = std::sqrt(CGAL::to_double(CGAL::squared_distance(a[0], b[0])));
        for (const double distance : {gap, gap * (1 + 1e-15), gap * (1 + 1e-9), 2 * gap}) {
          if (!(distance > 0) || !std::isfinite(distance)) continue;
          const bool is_proven = corners_nearer_than(corners_of(a), corners_of(b), distance);
          proven += is_proven ? 1 : 0;
          near += distance > gap * (1 + 1e-12) ? 1 : 0;
          ASSERT_TRUE(!is_proven || triangles_nearer_than(a, b, distance)) << kind.name << ' ' << scale;
        }
        ASSERT_TRUE(boxes_meet(corners_of(a), corners_of(b)) || !triangles_intersect(a, b)) << kind.name;
      }
  EXPECT_GT(proven, near / 2);
}

TEST(Corners_nearer_than, proves_nothing_where_squares_vanish) {
  // The square of the distance rounds up to the least double; that of the gap is a sum of three that round to zero.
  const double unit = 0x1p-538, origin[] = {0, 0, 0}, beyond[] = {unit, unit, unit};
  EXPECT_FALSE(corners_nearer_than({origin, origin, origin}, {beyond, beyond, beyond}, 1.5 * unit));
  EXPECT_TRUE(corners_nearer_than({origin, origin, origin}, {origin, origin, origin}, 0x1p-400));
}

TEST(Triangles_nearer_than, is_strict) {
  for (const auto& c : exactly_apart) {
    ASSERT_EQ(exact_squared_distance(as_triangle(c.a), as_triangle(c.b)), square(c.distance)) << c.name;
    for (const auto& [scale, offset] : {std::pair{1.0, 0.0}, {1.0, 0x1p20}, {0x1p-300, 0.0}, {0x1p300, 0.0}}) {
      const auto a = as_triangle(c.a, scale, offset), b = as_triangle(c.b, scale, offset);
      const double distance = scale * c.distance;
      EXPECT_FALSE(triangles_nearer_than(a, b, distance)) << c.name;
      EXPECT_FALSE(triangles_nearer_than(b, a, distance)) << c.name;
      EXPECT_TRUE(triangles_nearer_than(a, b, std::nextafter(distance, 2 * distance))) << c.name;
      EXPECT_TRUE(triangles_nearer_than(b, a, std::nextafter(distance, 2 * distance))) << c.name;
      EXPECT_EQ(closest_points(a, b).distance, distance) << c.name;
    }
  }
}

TEST(Triangles_nearer_than, means_an_intersection_at_distances_of_zero_and_less) {
  const auto a = as_triangle(large_base);
  const auto touching = as_triangle({{{1, 1, 0}, {1, 1, 9}, {2, 1, 9}}});
  const auto above = as_triangle({{{1, 1, 1}, {1, 1, 9}, {2, 1, 9}}});
  for (const double distance : {0.0, -1.0, -infinity}) {
    EXPECT_TRUE(triangles_nearer_than(a, touching, distance));
    EXPECT_FALSE(triangles_nearer_than(a, above, distance));
  }
  EXPECT_TRUE(triangles_nearer_than(a, touching, 1e-300));
  EXPECT_TRUE(triangles_nearer_than(a, above, infinity));
}

TEST(Distance_lower_bound, is_never_above_the_distance_of_the_boxes_and_close_to_it) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-1, 1), exponent(-60, 0);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto point = [&]() -> Eigen::Vector3d {
      return Eigen::Vector3d(place(random), place(random), place(random)) * std::exp2(exponent(random));
    };
    Box a(point()), b(point());
    a.extend(point()), b.extend(point());
    for (const double scale : {1.0, 0x1p-300, 0x1p300, 0x1p-1050, 0x1p1020}) {
      const Box s(scale * a.min(), scale * a.max()), t(scale * b.min(), scale * b.max());
      Rational squared = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Rational below = Rational(s.min()[axis]) - Rational(t.max()[axis]);
        const Rational above = Rational(t.min()[axis]) - Rational(s.max()[axis]);
        const Rational gap = below > above ? below : above;
        if (gap > 0) squared += gap * gap;
      }
      const double bound = distance_lower_bound(s, t);
      ASSERT_EQ(bound, distance_lower_bound(t, s));
      ASSERT_GE(bound, 0);
      ASSERT_LE(square(bound), squared);
      const bool usual = scale > 0x1p-400 && scale < 0x1p400;
      ASSERT_GE(square(bound) * (usual ? 1 + Rational(0x1p-47) : Rational(3.0001)), squared);
    }
  }
}

TEST(Distance_lower_bound, stays_finite_at_the_greatest_coordinates) {
  constexpr double most = std::numeric_limits<double>::max();
  const Box low(Eigen::Vector3d::Constant(-most)), high(Eigen::Vector3d::Constant(most));
  EXPECT_EQ(distance_lower_bound(low, high), most);
}

/// The unit vector along a vector of exact numbers.
Eigen::Vector3d unit(const Exact_vector& exact) {
  Rational greatest = 0;
  for (int axis = 0; axis < 3; ++axis) greatest = std::max(greatest, CGAL::abs(exact[axis]));
  return Eigen::Vector3d(CGAL::to_double(exact.x() / greatest), CGAL::to_double(exact.y() / greatest),
                         CGAL::to_double(exact.z() / greatest))
      .normalized();
}

TEST(Closest_points, give_the_direction_of_a_gap_of_any_size) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1), inner(0.2, 0.4);
  std::size_t apart = 0;
  for (const double gap : {1e-2, 1e-6, 1e-9, 1e-12, 1e-14, 1e-15})
    for (int trial = 0; trial < 200; ++trial) {
      const auto corner = [&] {
        const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
        return Eigen::Vector3d(10 + x, 10 + y, 10 + z);
      };
      const auto as_point = [](const Eigen::Vector3d& p) { return Point(p.x(), p.y(), p.z()); };
      const Eigen::Vector3d p = corner(), q = corner(), r = corner();
      const Eigen::Vector3d normal = (q - p).cross(r - p).normalized();
      const double s = inner(random), t = inner(random);
      const Eigen::Vector3d tip = p + s * (q - p) + t * (r - p) + gap * normal;
      const Triangle floor{as_point(p), as_point(q), as_point(r)};
      const Triangle wall{as_point(tip), as_point(tip + normal + 0.3 * (q - p)),
                          as_point(tip + normal - 0.2 * (r - p))};
      const Exact_vector up = CGAL::cross_product(exact_point(floor[1]) - exact_point(floor[0]),
                                                  exact_point(floor[2]) - exact_point(floor[0]));
      // A short gap may be rounded to zero.
      if (!((exact_point(wall[0]) - exact_point(floor[0])) * up > 0)) continue;
      ++apart;
      EXPECT_LT((closest_points(wall, floor).direction - unit(up)).norm(), 1e-9) << gap;
      EXPECT_LT((closest_points(floor, wall).direction + unit(up)).norm(), 1e-9) << gap;
    }
  EXPECT_GT(apart, 1000U);
}

TEST(Closest_points, have_a_direction_of_length_one_where_they_are_apart_and_none_where_they_meet) {
  for_pairs(150, [](const Triangle& a, const Triangle& b) {
    for (const double factor : {0x1p-1000, 1.0, 0x1p300}) {
      const auto found = closest_points(scaled(a, factor), scaled(b, factor));
      ASSERT_NEAR(found.direction.norm(), found.distance > 0 ? 1 : 0, 1e-15);
    }
  });
  const auto flat = [](double z) { return Triangle{Point(z, z, z), Point(1, z, z), Point(z, 1, z)}; };
  for (const double gap : {1e-318, 2e-323, 5e-324}) {
    const Triangle tip{Point(0.25, 0.25, gap), Point(0.25, 0.5, 1), Point(0.5, 0.25, 1)};
    EXPECT_EQ(closest_points(tip, flat(0)).direction, Eigen::Vector3d::UnitZ());
  }
}

}  // namespace
}  // namespace lodestone
