// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/k_dop.h"

#include <gtest/gtest.h>

#include "support/leaves.h"

namespace lodestone {
namespace {

const std::vector<Eigen::Vector3d> octahedron{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
const auto cube = box_corners({1, 1, 1}, Eigen::Matrix3d::Identity());

TEST(K_dop, with_directions_to_the_corners_fits_the_octahedron_exactly) {
  EXPECT_NEAR(volume_of<K_dop<14>>(octahedron).volume(), 4.0 / 3, 1e-13);
  EXPECT_NEAR(volume_of<K_dop<26>>(octahedron).volume(), 4.0 / 3, 1e-13);
}

// |x| + |y| <= 1 and so on: the rhombic dodecahedron whose corners are those of the octahedron and (1, 1, 1) / 2.
TEST(K_dop, with_directions_to_the_edges_is_a_rhombic_dodecahedron_around_the_octahedron) {
  EXPECT_NEAR(volume_of<K_dop<18>>(octahedron).volume(), 2, 1e-13);
}

TEST(K_dop, of_a_cube_is_the_cube) {
  EXPECT_NEAR(volume_of<K_dop<14>>(cube).volume(), 8, 1e-13);
  EXPECT_NEAR(volume_of<K_dop<18>>(cube).volume(), 8, 1e-13);
  EXPECT_NEAR(volume_of<K_dop<26>>(cube).volume(), 8, 1e-13);
  EXPECT_EQ(volume_of<K_dop<26>>(cube).extent(), 6);
}

// A cube of side 2 without its 8 corners, cut at |x| + |y| + |z| = 2, is the cuboctahedron.
TEST(K_dop, of_a_cuboctahedron_is_the_cuboctahedron) {
  std::vector<Eigen::Vector3d> points;
  for (const double s : {-1, 1})
    for (const double t : {-1, 1}) points.insert(points.end(), {{s, t, 0}, {s, 0, t}, {0, s, t}});
  EXPECT_NEAR(volume_of<K_dop<14>>(points).volume(), 20.0 / 3, 1e-13);
  EXPECT_NEAR(volume_of<K_dop<26>>(points).volume(), 20.0 / 3, 1e-13);
}

TEST(K_dop, of_a_regular_tetrahedron_is_the_tetrahedron) {
  const std::vector<Eigen::Vector3d> tetrahedron{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  EXPECT_NEAR(volume_of<K_dop<14>>(tetrahedron).volume(), 8.0 / 3, 1e-13);
}

TEST(K_dop, volume_grows_with_the_cube_of_the_size_at_any_position) {
  auto points = octahedron;
  for (auto& p : points) p = 1e90 * (p + Eigen::Vector3d(5, 6, 7));
  EXPECT_NEAR(volume_of<K_dop<14>>(points).volume() / 1e270, 4.0 / 3, 1e-11);
}

TEST(K_dop, separates_leaves_whose_boxes_meet) {
  const std::vector<Eigen::Vector3d> low{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}, high{{1, 0.5, 0}, {0.5, 1, 0}, {1, 1, 0}};
  EXPECT_FALSE(near(volume_of<K_dop<18>>(low), volume_of<K_dop<18>>(high), 0));
  EXPECT_FALSE(near(volume_of<K_dop<26>>(low), volume_of<K_dop<26>>(high), 0));
  EXPECT_FALSE(near(volume_of<K_dop<14>>(low), volume_of<K_dop<14>>(high), 0));
}

// Two parallel lines at distance 0.5 / sqrt(2) in a plane x + y = const.
TEST(K_dop, measures_the_margin_along_directions_of_any_length) {
  const std::vector<Eigen::Vector3d> low{{0, 1, 0}, {1, 0, 0}}, high{{0, 1.5, 0}, {1.5, 0, 0}};
  EXPECT_FALSE(near(volume_of<K_dop<18>>(low), volume_of<K_dop<18>>(high), 0.353553));
  EXPECT_TRUE(near(volume_of<K_dop<18>>(low), volume_of<K_dop<18>>(high), 0.353554));
}

}  // namespace
}  // namespace lodestone
