// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/orientation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "support/exact_point.h"
#include "support/instruction_sets.h"

namespace lodestone {
namespace {

using Four_points = std::array<Point, 4>;

CGAL::Sign exact_orientation(const Four_points& p) {
  return CGAL::orientation(exact_point(p[0]), exact_point(p[1]), exact_point(p[2]), exact_point(p[3]));
}

/// Points of a plane, moved by a rotation, and so off the plane by rounding.
Four_points in_a_turned_plane(std::mt19937_64& random, const Eigen::Matrix3d& rotation, double size, double height) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Four_points points;
  for (Point& p : points) {
    const Eigen::Vector3d turned = rotation * Eigen::Vector3d(size * unit(random), size * unit(random), height);
    p = Point(turned[0], turned[1], turned[2]);
  }
  return points;
}

/// Points of many kinds, most of them in a plane or nearly so.
std::vector<Four_points> samples() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> small(-2, 2);
  std::vector<Four_points> all;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Matrix3d rotation =
        Eigen::Quaterniond(unit(random), unit(random), unit(random), 1).normalized().matrix();
    all.push_back(in_a_turned_plane(random, rotation, 1, unit(random)));
    all.push_back(in_a_turned_plane(random, rotation, 0x1p-3, 1e6));
    for (const double size : {0x1p-400, 0x1p-260, 0x1p-240, 0x1p240, 0x1p260, 0x1p700})
      all.push_back(in_a_turned_plane(random, rotation, size, size));
    Four_points lattice, anywhere;
    for (Point& p : lattice) p = Point(small(random) / 3.0, small(random) / 3.0, small(random) / 3.0);
    for (Point& p : anywhere) p = Point(unit(random), unit(random), unit(random));
    all.push_back(lattice);
    all.push_back(anywhere);
    lattice[3] = lattice[0];
    all.push_back(lattice);
  }
  return all;
}

Point_quadruple pointers(const Four_points& p) { return {&p[0], &p[1], &p[2], &p[3]}; }

TEST(Orientation, is_exact_in_planes_but_for_rounding_and_in_planes_at_any_scale) {
  int of_sign[3] = {};
  for (const Four_points& p : samples()) {
    const auto expected = exact_orientation(p);
    ++of_sign[expected + 1];
    const std::array<Point_quadruple, 1> alone{pointers(p)};
    ASSERT_EQ(orientations(alone)[0], expected);
    ASSERT_EQ(doubtful_orientation(p[0], p[1], p[2], p[3]), expected);
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), expected);
    ASSERT_EQ(all_positive(alone), expected == CGAL::POSITIVE);
  }
  for (const int count : of_sign) EXPECT_GT(count, 1000);
}

TEST(Orientation, of_several_is_that_of_each_with_every_instruction_set) {
  const auto all = samples();
  for_instruction_sets([&] {
    for (std::size_t first = 0; first + most_orientations <= all.size(); first += 101) {
      std::array<Point_quadruple, most_orientations> quadruples;
      for (std::size_t i = 0; i < most_orientations; ++i) quadruples[i] = pointers(all[first + i]);
      const auto signs = orientations(quadruples);
      bool positive = true;
      for (std::size_t i = 0; i < most_orientations; ++i) {
        const auto expected = exact_orientation(all[first + i]);
        ASSERT_EQ(signs[i], expected);
        positive &= expected == CGAL::POSITIVE;
      }
      ASSERT_EQ(all_positive(quadruples), positive);
    }
  });
}

TEST(Orientation, all_are_positive_only_if_no_single_one_is_not) {
  const Four_points above{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  // Four points that would be in a plane if numbers like 0.1 were not rounded.
  const Four_points beyond{Point(0.1, 0.2, 0.3), Point(0.4, 0.1, 0.7), Point(0.7, 0.3, 0.2), Point(0.4, 0.2, 0.4)};
  Four_points turned = beyond;
  std::swap(turned[0], turned[1]);
  ASSERT_NE(exact_orientation(beyond), CGAL::ZERO);
  EXPECT_TRUE(all_positive(std::vector{pointers(above), pointers(above)}));
  EXPECT_NE(all_positive(std::vector{pointers(above), pointers(beyond)}),
            all_positive(std::vector{pointers(above), pointers(turned)}));
}

}  // namespace
}  // namespace lodestone
