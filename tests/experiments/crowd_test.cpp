// SPDX-License-Identifier: GPL-3.0-or-later
#include "many_bodies/crowd.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

/// The mean of the vertices.
Eigen::Vector3d centre_of(const Surface_mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : mesh.points()) sum += Eigen::Vector3d(p.x(), p.y(), p.z());
  return sum / static_cast<double>(mesh.number_of_vertices());
}

TEST(Crowd, a_body_has_as_many_near_others_at_any_size) {
  // By drawing: the side is right if pairs of places in the cube are nearer than 1.5 with probability 1.3 / (n - 1).
  std::mt19937_64 random(1);
  for (const std::size_t bodies : {4, 20, 100}) {
    std::uniform_real_distribution<double> place(0, side_of_crowd(bodies));
    constexpr int draws = 400'000;
    int near = 0;
    for (int i = 0; i < draws; ++i) {
      double squared = 0;
      for (int axis = 0; axis < 3; ++axis) squared += std::pow(place(random) - place(random), 2);
      near += squared < 1.5 * 1.5 ? 1 : 0;
    }
    const double p = 1.3 / static_cast<double>(bodies - 1);
    EXPECT_NEAR(double(near) / draws, p, 5 * std::sqrt(p * (1 - p) / draws)) << bodies;
  }
}

TEST(Crowd, grows_like_a_cube_of_constant_density_when_it_is_large) {
  EXPECT_NEAR(std::pow(side_of_crowd(8'000'000) / side_of_crowd(1'000'000), 3), 8, 0.3);
}

TEST(Crowd, of_fewer_than_three_bodies_is_refused) { EXPECT_THROW(crowd(2, 1), Bad_argument); }

TEST(Crowd, is_the_same_every_time) {
  Scene a = crowd(9, 5), b = crowd(9, 5);
  ASSERT_EQ(a.objects.size(), 9U);
  EXPECT_EQ(a.frames, 5U);
  for (std::size_t o = 0; o < 9; ++o) {
    pose(a.objects[o], 3);
    pose(b.objects[o], 3);
    EXPECT_TRUE(std::ranges::equal(a.objects[o].mesh.points(), b.objects[o].mesh.points()));
  }
}

TEST(Crowd, bodies_move_on_closed_paths_within_the_cube) {
  Scene scene = crowd(12, 240);
  const double half = side_of_crowd(12) / 2;
  for (auto& object : scene.objects) {
    EXPECT_GE(object.mesh.number_of_faces(), 1000U);
    EXPECT_LE(object.mesh.number_of_faces(), 5000U);
    pose(object, 0);
    const Eigen::Vector3d start = centre_of(object.mesh);
    EXPECT_LT(start.cwiseAbs().maxCoeff(), half + 0.5) << object.name;
    pose(object, 120);
    EXPECT_GT((centre_of(object.mesh) - start).norm(), 0.05) << object.name;
    pose(object, 240);
    EXPECT_LT((centre_of(object.mesh) - start).norm(), 0.3) << object.name;
  }
}

}  // namespace
}  // namespace lodestone
