// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/oriented_box.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/leaves.h"
#include "support/slab_membership.h"

namespace lodestone {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box_corners = std::vector<Eigen::Vector3d>;

/// Whether two boxes, given by their corners, have a common point, exactly: some of their faces do, or one is in the
/// other.
bool boxes_meet(const Box_corners& a, const Box_corners& b) {
  constexpr int sides[6][4]{{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  const auto triangles = [&](const Box_corners& corners) {
    const auto point = [&](int k) { return Kernel::Point_3(corners[k].x(), corners[k].y(), corners[k].z()); };
    std::vector<Kernel::Triangle_3> result;
    for (const auto& side : sides) {
      result.emplace_back(point(side[0]), point(side[1]), point(side[2]));
      result.emplace_back(point(side[0]), point(side[2]), point(side[3]));
    }
    return result;
  };
  for (const auto& s : triangles(a))
    for (const auto& t : triangles(b))
      if (CGAL::do_intersect(s, t)) return true;
  const auto contains = [](const Box_corners& box, const Eigen::Vector3d& p) {
    for (const int k : {1, 2, 4}) {
      const Eigen::Vector3d edge = box[k] - box[0];
      const double place = edge.dot(p - box[0]);
      if (place < 0 || place > edge.squaredNorm()) return false;
    }
    return true;
  };
  return contains(a, b[0]) || contains(b, a[0]);
}

TEST(Oriented_box, of_a_turned_box_is_the_box) {
  std::mt19937_64 random(21);
  for (int sample = 0; sample < 1000; ++sample) {
    const Eigen::Vector3d half(1, 0.5 + 0.3 * vector_in_cube(random).x(), 0.1);
    const auto box = volume_of<Oriented_box>(box_corners(half, random_turn(random), 3 * vector_in_cube(random)));
    EXPECT_NEAR(box.volume(), 8 * half.prod(), 1e-9 * half.prod());
    EXPECT_NEAR(box.extent(), 2 * half.sum(), 1e-9);
  }
}

TEST(Oriented_box, of_a_turned_rectangle_or_segment_is_flat) {
  std::mt19937_64 random(22);
  for (const double width : {0.4, 0.0})
    for (int sample = 0; sample < 1000; ++sample) {
      const auto box = volume_of<Oriented_box>(box_corners({1, width, 0}, random_turn(random), vector_in_cube(random)));
      EXPECT_NEAR(box.extent(), 2 * (1 + width), 1e-6);
      EXPECT_LE(*std::ranges::min_element(box.half), 1e-7);
    }
}

TEST(Oriented_box, of_an_upright_cube_is_the_cube) {
  const auto box = volume_of<Oriented_box>(box_corners({1, 1, 1}, Eigen::Matrix3d::Identity(), {0.5, 2, 3}));
  EXPECT_NEAR(box.volume(), 8, 1e-12);
  EXPECT_EQ(box.centre[1], 2);
}

TEST(Oriented_box, is_the_same_shape_at_every_size) {
  std::mt19937_64 random(23);
  const auto corners = box_corners({1, 0.6, 0.1}, random_turn(random), {0, 0, 0});
  for (const int exponent : {-900, -300, 300, 900}) {
    auto scaled = corners;
    for (auto& p : scaled)
      p = Eigen::Vector3d(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    EXPECT_NEAR(std::ldexp(volume_of<Oriented_box>(scaled).extent(), -exponent), 3.4, 1e-9);
  }
}

TEST(Oriented_box, of_two_halves_of_a_box_is_about_the_box) {
  std::mt19937_64 random(24);
  for (int sample = 0; sample < 1000; ++sample) {
    const Eigen::Matrix3d turn = random_turn(random);
    const Eigen::Vector3d step = turn * Eigen::Vector3d(1, 0, 0);
    const auto a = volume_of<Oriented_box>(box_corners({1, 0.5, 0.25}, turn, -step)),
               b = volume_of<Oriented_box>(box_corners({1, 0.5, 0.25}, turn, step));
    Oriented_box both;
    both.enclose(a, b);
    EXPECT_NEAR(both.volume(), 2, 1e-8);
  }
}

TEST(Oriented_box, is_near_another_exactly_if_the_two_meet) {
  std::mt19937_64 random(25);
  int met = 0;
  for (int sample = 0; sample < 4000; ++sample) {
    const Eigen::Vector3d half(1, 0.6, 0.02 + 0.3 * (sample % 2));
    const auto a = box_corners(half, random_turn(random), {0, 0, 0});
    const auto b = box_corners(half, random_turn(random), 1.5 * vector_in_cube(random));
    met += boxes_meet(a, b);
    ASSERT_EQ(near(volume_of<Oriented_box>(a), volume_of<Oriented_box>(b), 0), boxes_meet(a, b)) << sample;
    ASSERT_EQ(near(volume_of<Oriented_box>(b), volume_of<Oriented_box>(a), 0), boxes_meet(a, b)) << sample;
  }
  EXPECT_GT(met, 1000);
  EXPECT_LT(met, 3000);
}

/// The smallest box about a centre that has the axes of another and a point in it, exactly.
Oriented_box smallest_up_to(const Eigen::Vector3d& p, const Eigen::Vector3d& centre, Oriented_box box) {
  for (int i = 0; i < 3; ++i) box.centre[i] = centre[i];
  for (int i = 0; i < 3; ++i) box.half[i] = std::abs(Eigen::Vector3d(box.axes[i]).dot(p - centre)) * (1 - 1e-15);
  while (!inside(box, exact_point(p)))
    for (double& half : box.half) half = std::nextafter(half, INFINITY);
  return box;
}

TEST(Oriented_box, is_near_another_that_shares_a_corner) {
  std::mt19937_64 random(26);
  for (const double offset : {0.0, 0x1p20})
    for (int sample = 0; sample < 1000; ++sample) {
      const auto axes = volume_of<Oriented_box>(box_corners({1, 0.6, 0.1}, random_turn(random), {0, 0, 0}));
      const Eigen::Vector3d p = vector_in_cube(random) + Eigen::Vector3d(offset, 0, 0);
      const Eigen::Vector3d step = vector_in_cube(random);
      const auto a = smallest_up_to(p, p + step, axes), b = smallest_up_to(p, p - 0.7 * step, axes);
      ASSERT_TRUE(near(a, b, 0) && near(b, a, 0));
    }
}

// The nearest parts are two perpendicular edges, one of each beam: only their cross product separates them.
TEST(Oriented_box, measures_the_margin_from_edge_to_edge) {
  const Eigen::Matrix3d about_y = Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitY()).matrix();
  const Eigen::Matrix3d about_x = Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitX()).matrix();
  const double height = (1 + 0.8) / std::sqrt(2.0);
  const auto a = volume_of<Oriented_box>(box_corners({1, 3, 0.8}, about_y, {0, 0, 0}));
  const auto b = volume_of<Oriented_box>(box_corners({3, 1, 0.8}, about_x, {0, 0, 2 * height + 0.5}));
  EXPECT_FALSE(near(a, b, 0));
  EXPECT_FALSE(near(a, b, 0.5 - 1e-9));
  EXPECT_TRUE(near(a, b, 0.5 + 1e-9));
}

// A long edge slanted at a small angle against the other's: the cross product is short, and so is the gap along it.
TEST(Oriented_box, measures_the_margin_along_short_cross_products) {
  for (const double angle : {0.1, 1e-3, 1e-5}) {
    const Eigen::Matrix3d slant = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).matrix();
    const auto a = volume_of<Oriented_box>(box_corners({1, 0.1, 0.05}, Eigen::Matrix3d::Identity(), {0, 0, 0}));
    const auto b = volume_of<Oriented_box>(box_corners({1, 0.1, 0.05}, slant, {0, 0, 0.6}));
    EXPECT_FALSE(near(a, b, 0.499));
    EXPECT_TRUE(near(a, b, 0.501));
  }
}

}  // namespace
}  // namespace lodestone
