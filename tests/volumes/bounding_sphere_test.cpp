// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/bounding_sphere.h"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <gtest/gtest.h>

#include <limits>

#include "lodestone/mesh/errors.h"
#include "lodestone/volumes/bounding_volume.h"
#include "support/ball_membership.h"
#include "support/guarded_coordinates.h"
#include "support/instruction_sets.h"
#include "support/leaves.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

static_assert(Bounding_volume<Bounding_sphere>);

constexpr double most = std::numeric_limits<double>::max();

double smallest_radius(const Leaf& leaf) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  std::vector<Kernel::Point_3> points;
  for (std::size_t i = 0; i < leaf.coordinates.size(); i += 3)
    points.emplace_back(leaf.coordinates[i], leaf.coordinates[i + 1], leaf.coordinates[i + 2]);
  return CGAL::Min_sphere_of_spheres_d<Traits>(points.begin(), points.end()).radius();
}

TEST(Bounding_sphere, contains_the_corners_of_random_triangles_exactly) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d offset = (i % 2) * 0x1p20 * random_vector(random), a = random_vector(random);
    const Eigen::Vector3d b = a + std::pow(10, -(i % 17)) * random_vector(random), c = a + random_vector(random);
    const Leaf leaf = strip({a + offset, b + offset, c + offset});
    const auto ball = volume_of<Bounding_sphere>(leaf);
    for (std::size_t place = 0; place < 3; ++place) ASSERT_TRUE(inside(ball, exact_point(leaf.point(place))));
    // Points are close to the border, so that a missing widening is detected.
    ASSERT_LE(ball.radius, 1.01 * (a - b).norm() + 1.01 * (a - c).norm());
  }
}

TEST(Bounding_sphere, is_at_most_one_per_cent_larger_than_the_smallest) {
  std::mt19937_64 random(2);
  const auto check = [](const Leaf& leaf) {
    const double radius = volume_of<Bounding_sphere>(leaf).radius, smallest = smallest_radius(leaf);
    EXPECT_LE(radius, 1.01 * smallest);
    EXPECT_GE(radius, smallest * (1 - 1e-14));
  };
  for (const auto& [name, leaf] : leaf_cases()) {
    SCOPED_TRACE(name);
    check(leaf);
    for (int i = 0; i < 100; ++i) {
      Leaf deformed = leaf;
      for (double& x : deformed.coordinates) x += 0.1 * random_vector(random).x();
      check(deformed);
    }
  }
}

TEST(Bounding_sphere, equals_the_closed_form) {
  using V = Eigen::Vector3d;
  struct Case {
    Leaf leaf;
    V centre;
    double radius;
  };
  const std::vector<Case> cases{
      {strip({V(1, 2, 3)}), V(1, 2, 3), 0},
      {strip({V(1, 2, 3), V(1, 2, 7)}), V(1, 2, 5), 2},
      {strip({V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)}), V(0.5, 0.5, 0), std::sqrt(0.5)},
      {strip({V(1, 1, 1), V(1, -1, -1), V(-1, 1, -1), V(-1, -1, 1)}), V(0, 0, 0), std::sqrt(3)},
      {strip({V(0, 0, 0), V(4, 0, 0), V(1, 0.1, 0), V(2, 1, 1)}), V(2, 0, 0), 2},
      {strip({V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(1, 1, 0), V(0, 0, 1), V(1, 0, 1), V(0, 1, 1), V(1, 1, 1)}),
       V(0.5, 0.5, 0.5), std::sqrt(0.75)}};
  for (const auto& [leaf, centre, radius] : cases) {
    const auto ball = volume_of<Bounding_sphere>(leaf);
    EXPECT_NEAR(ball.radius, radius, 1e-14 * radius);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(ball.centre[axis], centre[axis], 1e-14 * radius);
    EXPECT_EQ(ball.extent(), 2 * ball.radius);
    EXPECT_NEAR(ball.volume(), 4.1887902047863905 * radius * radius * radius, 1e-13 * ball.volume());
  }
}

/// Whether the exact ball `b` lies in the exact ball `a`: the distance of their centres is not above a - b.
bool holds(const Bounding_sphere& a, const Bounding_sphere& b) {
  if (std::isinf(a.radius)) return true;
  const Rational difference = Rational(a.radius) - Rational(b.radius);
  return difference >= 0 && squared_distance(exact_point(a.centre), exact_point(b.centre)) <= difference * difference;
}

Bounding_sphere ball_at(const Eigen::Vector3d& centre, double radius) {
  return {.centre = {centre.x(), centre.y(), centre.z()}, .radius = radius};
}

TEST(Bounding_sphere, of_two_balls_contains_both_and_is_the_smallest) {
  std::mt19937_64 random(3);
  for (const double unit : {1.0, 0x1p-300, 0x1p300, 0x1p-600, 0x1p600, 0x1p-1070, 0x1p1019})
    for (int i = 0; i < 3000; ++i) {
      const double far = i % 3 == 0 && unit < 0x1p1000 ? 0x1p20 : 0;
      const Eigen::Vector3d p = far * Eigen::Vector3d::Ones() + random_vector(random), step = random_vector(random);
      const double radius = std::abs(random_vector(random).x());
      const auto a = ball_at(unit * p, unit), b = ball_at(unit * (p + std::pow(2, -(i % 60)) * step), unit * radius);
      const auto both = volume_of(a, b);
      ASSERT_TRUE(holds(both, a) && holds(both, b));
      const double distance = (p - (p + std::pow(2, -(i % 60)) * step)).norm();
      const double smallest = std::max({1.0, radius, (1 + radius + distance) / 2});
      if (unit > 0x1p-1000) {
        ASSERT_LE(both.radius / unit, smallest * (1 + 1e-13) + 1e-15 * far);
      }
      Bounding_sphere in_place = a;
      in_place.enclose(in_place, b);
      ASSERT_EQ(in_place, both);
    }
}

TEST(Bounding_sphere, of_a_ball_inside_another_is_the_outer_one) {
  const auto large = ball_at({1, 2, 3}, 3), small = ball_at({1, 2, 4}, 1), inner = ball_at({1, 2, 3}, 1);
  for (const auto& ball : {large, small, inner, ball_at({1, 2, 3}, 0), ball_at({1, 2, 3}, infinity)}) {
    EXPECT_EQ(volume_of(ball, ball), ball);
    EXPECT_EQ(volume_of(ball, large), ball.radius > 3 ? ball : large);
    EXPECT_EQ(volume_of(large, ball), ball.radius > 3 ? ball : large);
  }
}

TEST(Bounding_sphere, is_near_another_unless_they_are_apart) {
  std::mt19937_64 random(4);
  int apart = 0;
  for (const double unit : {1.0, 0x1p-300, 0x1p300, 0x1p-600, 0x1p600, 0x1p-1060, 0x1p1019})
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d p = (i % 2) * (unit < 0x1p1000 ? 0x1p10 : 1) * random_vector(random),
                            step = random_vector(random);
      const double a_radius = step.norm() * 0.3, margin = i % 3 == 0 ? 0 : a_radius / 2;
      // They touch, up to a little more than rounding.
      const double b_radius = (step.norm() - a_radius - margin) * (1 + (i % 7 - 3.0) * 0x1p-52);
      const auto a = ball_at(unit * p, unit * a_radius), b = ball_at(unit * (p + step), unit * b_radius);
      const Rational reach = Rational(a.radius) + Rational(b.radius) + Rational(unit * margin);
      const bool meet = squared_distance(exact_point(a.centre), exact_point(b.centre)) <= reach * reach;
      ASSERT_TRUE(near(a, b, unit * margin) || !meet);
      apart += !meet;
      // A clear distance is detected at any scale.
      ASSERT_FALSE(near(a, ball_at(unit * (p + 1.001 * step), b.radius), unit * margin) && unit > 0x1p-1000);
    }
  EXPECT_GT(apart, 1000);
}

TEST(Bounding_sphere, has_a_box_around_it) {
  for_placed_leaves([](const Leaf& leaf) {
    const auto ball = volume_of<Bounding_sphere>(leaf);
    const Aabb box = ball.bounds();
    const Exact_point centre = exact_point(ball.centre);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::isinf(ball.radius)) continue;
      const auto far = [&](double end) { return std::isinf(end) || abs(end - centre[axis]) >= ball.radius; };
      EXPECT_TRUE(far(box.low[axis]) && far(box.high[axis]));
    }
  });
}

TEST(Bounding_sphere, is_the_same_for_every_instruction_set_and_never_reads_past_the_last_vertex) {
  for_placed_leaves([](const Leaf& leaf) {
    const Guarded_coordinates guarded(leaf.coordinates);
    for (std::size_t first = 0; first < leaf.vertices.size(); ++first) {
      const Leaf_faces last{guarded.values(), std::span(leaf.vertices).subspan(first), {}};
      Bounding_sphere best, other;
      best.enclose(last);
      for_instruction_sets([&] {
        other.enclose(last);
        ASSERT_EQ(other, best);
      });
    }
  });
}

TEST(Bounding_sphere, never_separates_on_overflow_underflow_or_nan) {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  const auto wide =
      volume_of<Bounding_sphere>(strip({Eigen::Vector3d(-most, -most, -most), Eigen::Vector3d(most, most, most)}));
  EXPECT_TRUE(std::isinf(wide.radius));
  const auto unit = ball_at(Eigen::Vector3d::Zero(), 1);
  EXPECT_TRUE(near(unit, wide, 0));
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_TRUE(near(unit, ball_at(Eigen::Vector3d(5, 5, bad), 1), 0));
    EXPECT_TRUE(near(unit, ball_at(Eigen::Vector3d(5, 5, 5), std::abs(bad)), 0));
    EXPECT_TRUE(near(unit, ball_at(Eigen::Vector3d(5, 5, 5), 1), std::abs(bad)));
    for (auto leaf : {grid(8, 8, [](const auto& p) { return p; }), strip({Eigen::Vector3d(1, 2, 3)})})
      for (double& x : leaf.coordinates) {
        const double before = std::exchange(x, bad);
        auto ball = volume_of<Bounding_sphere>(leaf);
        ball.enclose(ball, unit);
        EXPECT_TRUE(near(ball, unit, 0));
        x = before;
      }
  }
}

TEST(Bounding_sphere, encloses_two_whose_radii_differ_by_more_than_their_distance) {
  // Rounded up, neither encloses the other.
  const auto large = ball_at(Eigen::Vector3d(0, 0, 1e308), 1e308);
  const auto small = ball_at(Eigen::Vector3d(0, 1e290, 1e308), 1e308 * (1 - 0x1p-51));
  for (const auto& [a, b] : {std::pair(large, small), std::pair(small, large)}) {
    Bounding_sphere both;
    both.enclose(a, b);
    EXPECT_FALSE(std::isnan(both.radius));
    for (const double coordinate : both.centre) EXPECT_TRUE(std::isfinite(coordinate));
    EXPECT_GE(both.radius, 1e308);
  }
}

TEST(Bounding_sphere, refuses_more_vertices_than_a_leaf_can_have) {
  Bounding_sphere ball;
  const std::vector<Eigen::Vector3d> full(384, {1, 2, 3}), too_many(385, {1, 2, 3});
  EXPECT_NO_THROW(ball.enclose(strip(full).faces()));
  EXPECT_THROW(ball.enclose(strip(too_many).faces()), Bad_argument);
}

}  // namespace
}  // namespace lodestone
