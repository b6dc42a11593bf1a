// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/contact_normal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/distance_oracle.h"
#include "support/test_meshes.h"
#include "support/touching_triangles.h"
#include "support/triangle_pairs.h"

namespace lodestone {
namespace {

const Triangle floor_tile = as_triangle({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}});  // looks up

Eigen::Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

double highest(const Triangle& t, const Eigen::Vector3d& direction) {
  return std::max({direction.dot(vector(t[0])), direction.dot(vector(t[1])), direction.dot(vector(t[2]))});
}

double lowest(const Triangle& t, const Eigen::Vector3d& direction) { return -highest(t, -direction); }

/// Unit normal from a cross product in rational numbers; zero without area.
Eigen::Vector3d exact_unit_normal(const Triangle& t) {
  const auto exact = [](const Point& p) { return Rational_vector{p.x(), p.y(), p.z()}; };
  const auto n = cross(minus(exact(t[1]), exact(t[0])), minus(exact(t[2]), exact(t[0])));
  Rational most = 0;
  for (const auto& x : n) most = std::max(most, Rational(CGAL::abs(x)));
  if (most == 0) return Eigen::Vector3d::Zero();
  const auto part = [&](int axis) { return CGAL::to_double(Rational(n[axis] / most)); };
  return Eigen::Vector3d(part(0), part(1), part(2)).normalized();
}

TEST(Contact_normal, of_a_wall_through_a_floor_points_halfway_between_them) {
  // The wall looks along +x, so it is pushed up and back.
  const Triangle wall = as_triangle({{{1, 1, -1}, {1, 2, 5}, {1, 0, 5}}});
  const auto contact = contact_normal(wall, floor_tile);
  const double half = std::sqrt(0.5);
  EXPECT_LT((contact.normal - Eigen::Vector3d(-half, 0, half)).norm(), 1e-15);
  // Along the normal the floor reaches up to 0, at its corner in the origin, and the wall down to -2 / sqrt(2).
  EXPECT_NEAR(contact.depth, std::sqrt(2.0), 1e-15);
}

TEST(Contact_normal, is_the_other_face_s_normal_where_one_has_no_area) {
  const Triangle needle = as_triangle({{{1, 1, -1}, {1, 1, 3}, {1, 1, 5}}});
  const auto down = contact_normal(needle, floor_tile);
  EXPECT_EQ(down.normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(down.depth, 1);
  const auto up = contact_normal(floor_tile, needle);
  EXPECT_EQ(up.normal, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(up.depth, 1);
  const Triangle point = as_triangle({{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}});
  EXPECT_EQ(contact_normal(point, floor_tile).normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(contact_normal(point, floor_tile).depth, 0);
  for (const auto& both : {contact_normal(needle, point), contact_normal(point, point)}) {
    EXPECT_EQ(both.normal, Eigen::Vector3d::Zero());
    EXPECT_EQ(both.depth, 0);
  }
}

TEST(Contact_normal, is_that_of_the_second_face_where_both_normals_are_equal) {
  const Triangle within = as_triangle({{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}});
  EXPECT_EQ(contact_normal(within, floor_tile).normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(contact_normal(within, floor_tile).depth, 0);
  const Triangle tilted{Point(1, 1, 0), Point(2, 1, 1e-9), Point(1, 2, 0)};
  EXPECT_EQ(contact_normal(tilted, floor_tile).normal, Eigen::Vector3d(0, 0, 1));
  const Triangle turned{within[0], within[2], within[1]};
  EXPECT_EQ(contact_normal(turned, floor_tile).normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(contact_normal(floor_tile, turned).normal, Eigen::Vector3d(0, 0, -1));
}

TEST(Contact_normal, is_of_unit_length_and_moving_by_its_depth_leaves_the_projections_touching) {
  std::mt19937_64 random(1);
  std::size_t met = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const auto ia = random_triangle(random, 2 + trial % 20), ib = random_triangle(random, 2 + trial % 20);
    const auto a = as_triangle(ia), b = as_triangle(ib);
    const auto contact = contact_normal(a, b);
    if (is_degenerate(ia) && is_degenerate(ib)) {
      ASSERT_EQ(contact.normal, Eigen::Vector3d::Zero());
      ASSERT_EQ(contact.depth, 0);
      continue;
    }
    ASSERT_NEAR(contact.normal.norm(), 1, 1e-15);
    const double overlap = highest(b, contact.normal) - lowest(a, contact.normal);
    ASSERT_NEAR(contact.depth, std::max(overlap, 0.0), 1e-13);
    if (!triangles_intersect(a, b)) continue;
    ++met;
    ASSERT_GT(overlap, -1e-13);
  }
  EXPECT_GT(met, 2000U);
}

TEST(Contact_normal, is_the_difference_of_the_unit_normals_even_for_slivers) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-1, 1), exponent(-17, 0);
  const auto point = [&] {
    const double x = place(random), y = place(random), z = place(random);
    return Point(x, y, z);
  };
  std::size_t checked = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const auto sliver = [&] {
      const Point p = point(), q = point(), r = point();
      const double s = place(random), thick = std::pow(10, exponent(random));
      const auto third = [&](int axis) { return p[axis] + s * (q[axis] - p[axis]) + thick * r[axis]; };
      return Triangle{p, q, Point(third(0), third(1), third(2))};
    };
    const Triangle a = sliver(), b = sliver();
    const Eigen::Vector3d difference = exact_unit_normal(b) - exact_unit_normal(a);
    if (difference.norm() < 0.1) continue;
    ++checked;
    for (const double scale : {1.0, 0x1p-300, 0x1p300, 0x1p-900, 0x1p1000}) {
      const auto contact = contact_normal(scaled(a, scale), scaled(b, scale));
      ASSERT_LT((contact.normal - difference.normalized()).norm(), 1e-7) << scale;
    }
  }
  EXPECT_GT(checked, 4000U);
}

TEST(Contact_normal, is_reversed_when_the_triangles_are_swapped_and_scales_with_powers_of_two) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 5000; ++trial) {
    const auto a = as_triangle(random_triangle(random, 30)), b = as_triangle(random_triangle(random, 30));
    const auto contact = contact_normal(a, b), other = contact_normal(b, a);
    if (contact.normal != exact_unit_normal(b)) {
      ASSERT_EQ(other.normal, -contact.normal);
      ASSERT_EQ(other.depth, contact.depth);
    }
    for (const double scale : {0x1p-300, 0x1p300, 0x1p1000}) {
      const auto elsewhere = contact_normal(scaled(a, scale), scaled(b, scale));
      ASSERT_EQ(elsewhere.normal, contact.normal);
      ASSERT_EQ(elsewhere.depth, scale * contact.depth);
    }
  }
}

TEST(Contact_normal, is_finite_at_the_smallest_and_greatest_coordinates) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  for (const double scale : {least, 3 * least, 0x1p-1022, 1e307}) {
    const Triangle tile = scaled(floor_tile, scale / 4);
    const Triangle wall{Point(0, 0, -scale), Point(scale, 0, scale), Point(0, scale, scale)};
    for (const auto& contact : {contact_normal(tile, wall), contact_normal(wall, tile)}) {
      EXPECT_TRUE(contact.normal.allFinite());
      EXPECT_TRUE(contact.normal.isZero(0) || std::abs(contact.normal.norm() - 1) < 1e-15);
      EXPECT_TRUE(std::isfinite(contact.depth) && contact.depth >= 0);
    }
    EXPECT_FALSE(contact_normal(wall, tile).normal.isZero(0));
  }
}

TEST(Contact_normal, is_right_for_a_triangle_of_any_size_beside_the_other) {
  const Triangle tile = as_triangle({{{0, 0, 0}, {3, 1, 1}, {1, 4, -2}}});
  const Triangle large = as_triangle({{{-3, -2, 1}, {5, -3, 0}, {-3, 6, 2}}});
  const Eigen::Vector3d expected = (exact_unit_normal(large) - exact_unit_normal(tile)).normalized();
  for (int exponent = 0; exponent > -1070; exponent -= 3) {
    const auto contact = contact_normal(scaled(tile, std::ldexp(1.0, exponent)), large);
    EXPECT_LT((contact.normal - expected).norm(), 1e-14) << exponent;
  }
}

TEST(Contact_normal, of_two_overlapping_balls_points_from_one_to_the_other) {
  const Eigen::Vector3d apart = Eigen::Vector3d(1.2, 1.3, 0.4);
  const Numbered_mesh a(sphere(8, 1, {apart.x(), apart.y(), apart.z()})), b(sphere(8));
  const auto triangle = [](const Numbered_mesh& mesh, std::size_t face) {
    return face_triangle(mesh.faces[face], [&](auto v) { return mesh.positions.row(v); });
  };
  std::size_t met = 0;
  for (std::size_t i = 0; i < a.faces.size(); ++i)
    for (std::size_t j = 0; j < b.faces.size(); ++j) {
      const auto s = triangle(a, i), t = triangle(b, j);
      if (!triangles_intersect(s, t)) continue;
      ++met;
      const auto contact = contact_normal(s, t);
      EXPECT_GT(contact.normal.dot(apart.normalized()), 0.9);
      EXPECT_LT(contact.depth, 0.5);
    }
  EXPECT_GT(met, 20U);
}

TEST(Gap_normal, of_a_wall_above_a_floor_points_up_and_gives_their_distance) {
  const Triangle floor = as_triangle({{{0, 0, 0}, {80, 0, 0}, {0, 80, 0}}});
  const Triangle wall = as_triangle({{{16, 8, 1}, {16, 32, 1}, {16, 16, 40}}});
  const auto gap = gap_normal(closest_points(wall, floor));
  EXPECT_LT((gap.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_EQ(gap.depth, -1);
  const auto other = gap_normal(closest_points(floor, wall));
  EXPECT_LT((other.normal + Eigen::Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(Gap_normal, has_length_one_at_any_scale) {
  const Triangle floor = as_triangle({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}});
  const Triangle tip = as_triangle({{{1, 1, 2}, {1, 2, 3}, {2, 1, 3}}});
  for (const int exponent : {-1000, -300, 0, 300, 1000}) {
    const auto a = scaled(tip, std::ldexp(1.0, exponent)), b = scaled(floor, std::ldexp(1.0, exponent));
    const auto gap = gap_normal(closest_points(a, b));
    EXPECT_LT((gap.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-15) << exponent;
    EXPECT_EQ(gap.depth, -std::ldexp(2.0, exponent));
  }
}

}  // namespace
}  // namespace lodestone
