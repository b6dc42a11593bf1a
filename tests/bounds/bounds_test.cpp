// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes from the parameters of a motion: every position as it is computed lies in them, and they are not much too
// large.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "lodestone/bounds/linear_bound.h"
#include "lodestone/bounds/motion_bound.h"
#include "lodestone/bounds/skin_bound.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/test_meshes.h"
#include "support/tree_checks.h"

namespace lodestone {
namespace {

static_assert(Motion_bound<Linear_bound> && Motion_bound<Skin_bound>);

double number(std::mt19937_64& random, double low = -1, double high = 1) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Whether all positions of all nodes are in their boxes; counts those that are not.
template <class Bound, class Points>
std::size_t outside(const Bound& bound, const Points& points, const Tree_layout& layout) {
  std::vector<double> coordinates(3 * std::size_t{points.vertex_count()});
  points.pose_all(coordinates);
  std::size_t count = 0;
  for (std::uint32_t node = 0; node < layout.node_count(); ++node) {
    const Aabb box = bound.box(node);
    for (std::uint32_t leaf = layout.node(node).leaf; leaf < layout.node(node).end_leaf; ++leaf)
      for (const auto v : layout.vertices(leaf))
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double x = coordinates[3 * v + axis];
          if (!(box.low[axis] <= x && x <= box.high[axis])) ++count;
        }
  }
  return count;
}

/// Mean over the nodes of how many times larger a box is than the smallest one.
template <class Bound, class Points>
double looseness(const Bound& bound, const Points& points, const Tree_layout& layout) {
  std::vector<double> coordinates(3 * std::size_t{points.vertex_count()});
  points.pose_all(coordinates);
  double sum = 0;
  for (std::uint32_t node = 0; node < layout.node_count(); ++node) {
    Aabb least;
    least.enclose(layout.leaf_faces(layout.node(node).leaf, coordinates));
    for (std::uint32_t leaf = layout.node(node).leaf + 1; leaf < layout.node(node).end_leaf; ++leaf) {
      Aabb other;
      other.enclose(layout.leaf_faces(leaf, coordinates));
      least.enclose(least, other);
    }
    sum += bound.box(node).extent() / least.extent();
  }
  return sum / static_cast<double>(layout.node_count());
}

/// Numbers of all sizes, zeros among them.
double wild(std::mt19937_64& random, int exponent) {
  const auto kind = random() % 8;
  if (kind == 0) return 0;
  return std::ldexp(number(random),
                    kind == 1 ? static_cast<int>(random() % static_cast<unsigned>(2 * exponent + 1)) - exponent : 0);
}

std::vector<Morph_target> wild_targets(std::uint32_t vertices, std::mt19937_64& random, int exponent) {
  std::vector<Morph_target> targets(random() % 6);
  for (auto& target : targets)
    for (std::uint32_t v = 0; v < vertices; ++v) {
      if (random() % 3 == 0) continue;
      target.vertices.push_back(v);
      for (int axis = 0; axis < 3; ++axis) target.offsets.push_back(wild(random, exponent));
    }
  return targets;
}

std::vector<double> wild_weights(std::size_t count, std::mt19937_64& random, int exponent) {
  std::vector<double> weights(count);
  for (double& weight : weights) weight = wild(random, exponent);
  return weights;
}

/// Rotations, scalings and shears, joints that flatten everything, and large translations.
Eigen::Affine3d wild_motion(std::mt19937_64& random, int exponent) {
  Eigen::Affine3d motion;
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 4; ++column) motion(row, column) = wild(random, exponent);
  return motion;
}

Joint_influences wild_influences(std::uint32_t vertices, std::size_t joints, std::mt19937_64& random) {
  Joint_influences influences;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const std::size_t count = 1 + random() % 5;
    for (std::size_t i = 0; i < count; ++i) {
      influences.joints.push_back(static_cast<std::uint32_t>(random() % joints));
      influences.weights.push_back(i == 0 ? number(random, 1e-3, 1) : std::max(0.0, wild(random, 40)));
    }
    influences.begin.push_back(static_cast<std::uint32_t>(influences.joints.size()));
  }
  return influences;
}

TEST(Linear_bound, contains_every_position_as_it_is_computed) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    Face_soup soup(icosphere(1 + random() % 4));
    const int exponent = round % 3 == 0 ? 0 : round % 3 == 1 ? 30 : 400;
    for (double& x : soup.coordinates) x = x * std::ldexp(1.0, round % 7 == 0 ? 40 : 0) + wild(random, exponent);
    const auto targets = wild_targets(soup.vertex_count(), random, exponent);
    Morphed_points points(soup.coordinates, targets);
    const Tree_layout layout(soup.faces, {}, soup.coordinates, {.leaf_faces = 2 + random() % 20});
    const Linear_bound bound(points, layout);
    ASSERT_EQ(bound.node_count(), layout.node_count());
    for (int pose = 0; pose < 3; ++pose) {
      EXPECT_EQ(outside(bound, points, layout), 0U) << round;
      points.set_weights(wild_weights(targets.size(), random, exponent));
    }
  }
}

TEST(Skin_bound, contains_every_position_as_it_is_computed) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 400; ++round) {
    Face_soup soup(icosphere(1 + random() % 4));
    const int exponent = round % 3 == 0 ? 0 : round % 3 == 1 ? 30 : 300;
    const auto targets = round % 2 == 0 ? std::vector<Morph_target>() : wild_targets(soup.vertex_count(), random, 10);
    const std::size_t joints = 1 + random() % 12;
    Skinned_points points(Morphed_points(soup.coordinates, targets),
                          wild_influences(soup.vertex_count(), joints, random), joints);
    const Tree_layout layout(soup.faces, {}, soup.coordinates, {.leaf_faces = 2 + random() % 20});
    const Skin_bound bound(points, layout);
    ASSERT_EQ(bound.node_count(), layout.node_count());
    for (int pose = 0; pose < 3; ++pose) {
      EXPECT_EQ(outside(bound, points, layout), 0U) << round;
      std::vector<Eigen::Affine3d> motions(joints);
      for (auto& motion : motions) motion = wild_motion(random, exponent);
      points.set_joints(motions);
      points.set_weights(wild_weights(targets.size(), random, 10));
    }
  }
}

/// The second target undoes the first up to rounding, which is much larger than what skinning rounds.
TEST(Motion_bound, contains_positions_whose_targets_cancel) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 50; ++round) {
    const Face_soup soup(icosphere(6));
    std::vector<Morph_target> targets(2);
    for (std::size_t i = 0; i < soup.coordinates.size(); ++i)
      for (auto& target : targets) target.offsets.push_back(0x1p33);
    Skinned_points points(Morphed_points(soup.coordinates, targets), wild_influences(soup.vertex_count(), 1, random),
                          1);
    const Tree_layout layout(soup.faces, {}, soup.coordinates, {.leaf_faces = 2 + random() % 6});
    const Linear_bound linear(points.shape(), layout);
    const Skin_bound skin(points, layout);
    points.set_weights(std::vector{1.0, -1.0});
    EXPECT_EQ(outside(linear, points.shape(), layout), 0U);
    EXPECT_EQ(outside(skin, points, layout), 0U);
  }
}

/// All vertices follow one joint.
Skinned_points rigid(const Face_soup& soup) {
  const std::vector<std::uint32_t> joints(soup.vertex_count(), 0);
  const std::vector<double> weights(soup.vertex_count(), 1);
  return {soup.coordinates, Joint_influences::of(1, joints, weights), 1};
}

/// Where all vertices of a node move alike, the box is that of the moved corners.
TEST(Skin_bound, of_vertices_that_follow_one_joint_is_the_box_of_their_turned_box) {
  const Face_soup soup(icosphere(6));
  auto points = rigid(soup);
  const Tree_layout layout(soup.faces, {}, soup.coordinates, {});
  const Skin_bound bound(points, layout);
  points.set_joints(std::vector{Eigen::Affine3d(Eigen::AngleAxisd(std::acos(-1) / 4, Eigen::Vector3d::UnitZ()))});
  Aabb rest;
  rest.enclose(layout.leaf_faces(0, soup.coordinates));
  for (std::size_t leaf = 1; leaf < layout.leaf_count(); ++leaf) {
    Aabb other;
    other.enclose(layout.leaf_faces(leaf, soup.coordinates));
    rest.enclose(rest, other);
  }
  const Aabb box = bound.box(0);
  EXPECT_NEAR(box.high[0], (rest.high[0] - rest.low[1]) / std::sqrt(2), 1e-13);
  EXPECT_NEAR(box.low[1], (rest.low[0] + rest.low[1]) / std::sqrt(2), 1e-13);
  EXPECT_NEAR(box.high[2], rest.high[2], 1e-13);
}

/// At the elbow of a bent arm the hull of both bones' boxes is much larger than the true extent.
TEST(Skin_bound, is_tight_at_joints_and_below) {
  Surface_mesh mesh = icosphere(40);
  for (const auto v : mesh.vertices())
    mesh.point(v) = Point(5 * mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  const Face_soup soup(mesh);
  std::vector<std::uint32_t> joints;
  std::vector<double> weights;
  for (std::uint32_t v = 0; v < soup.vertex_count(); ++v) {
    const double second = std::clamp(soup.coordinates[3 * v] + 0.5, 0.0, 1.0);
    joints.insert(joints.end(), {0, 1});
    weights.insert(weights.end(), {1 - second, second});
  }
  Skinned_points points(soup.coordinates, Joint_influences::of(2, joints, weights), 2);
  const Tree_layout layout(soup.faces, {}, soup.coordinates, {});
  const Skin_bound bound(points, layout);
  const Eigen::Affine3d bent(Eigen::AngleAxisd(1.4, Eigen::Vector3d::UnitZ()));
  points.set_joints(std::vector{Eigen::Affine3d::Identity(), bent});
  EXPECT_EQ(outside(bound, points, layout), 0U);
  const double mean = looseness(bound, points, layout);
  EXPECT_GE(mean, 1);
  EXPECT_LT(mean, 1.5);
}

/// One sphere follows one joint, or one target, and another beside it the other one.
TEST(Motion_bound, of_a_node_whose_children_move_differently_contains_both) {
  Surface_mesh mesh = icosphere(4), other = mesh;
  shift(mesh, -5);
  shift(other, 5);
  append(mesh, other);
  const Face_soup soup(mesh);
  const Tree_layout layout(soup.faces, {}, soup.coordinates, {.leaf_faces = 8});
  std::vector<std::uint32_t> joints;
  std::vector<Morph_target> targets(2);
  for (std::uint32_t v = 0; v < soup.vertex_count(); ++v) {
    const std::uint32_t half = soup.coordinates[3 * v] < 0 ? 0 : 1;
    joints.push_back(half);
    targets[half].vertices.push_back(v);
    targets[half].offsets.insert(targets[half].offsets.end(), {half == 0 ? 10.0 : -10.0, 0, 1});
  }
  Morphed_points morphed(soup.coordinates, targets);
  const std::vector<double> weights(soup.vertex_count(), 1);
  Skinned_points skinned(soup.coordinates, Joint_influences::of(1, joints, weights), 2);
  const Linear_bound linear(morphed, layout);
  const Skin_bound skin(skinned, layout);
  for (const double way : {10.0, -10.0}) {
    morphed.set_weights(std::vector{way, way / 3});
    EXPECT_EQ(outside(linear, morphed, layout), 0U);
    skinned.set_joints(std::vector{Eigen::Affine3d(Eigen::Translation3d(way, 0, way)),
                                   Eigen::Affine3d(Eigen::Translation3d(-way, 0, way))});
    EXPECT_EQ(outside(skin, skinned, layout), 0U);
  }
}

TEST(Skin_bound, that_overflows_says_nothing) {
  const Face_soup soup(icosphere(2));
  auto points = rigid(soup);
  const Tree_layout layout(soup.faces, {}, soup.coordinates, {});
  const Skin_bound bound(points, layout);
  points.set_joints(
      std::vector{Eigen::Affine3d(Eigen::Translation3d(1.7e308, 0, 0) * Eigen::Scaling(1.7e308, 1.0, 1.0))});
  const Aabb box = bound.box(0);
  EXPECT_EQ(box.low[0], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(box.high[0], std::numeric_limits<double>::infinity());
  EXPECT_NEAR(box.high[1], 1, 0.01);
}

TEST(Skin_bound, contains_the_smallest_numbers) {
  auto soup = Face_soup(icosphere(2));
  for (double& x : soup.coordinates) x = x < 0 ? -5e-324 : 1e-323;
  auto points = rigid(soup);
  const Tree_layout layout(soup.faces, {}, soup.coordinates, {.leaf_faces = 4});
  const Skin_bound bound(points, layout);
  points.set_joints(std::vector{Eigen::Affine3d(Eigen::Scaling(1e100))});
  EXPECT_EQ(outside(bound, points, layout), 0U);
}

TEST(Skin_bound, of_targets_that_overflow_says_nothing) {
  std::mt19937_64 random(3);
  const Face_soup soup(icosphere(4));
  Morph_target target;
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i) target.offsets.push_back(number(random, -20, 20));
  Skinned_points points(Morphed_points(soup.coordinates, std::vector{target}),
                        wild_influences(soup.vertex_count(), 40, random), 40);
  const Tree_layout layout(soup.faces, {}, soup.coordinates, {});
  const Skin_bound bound(points, layout);
  points.set_weights(std::vector{1e308});
  for (std::uint32_t node = 0; node < layout.node_count(); ++node)
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(bound.box(node).low[axis], -std::numeric_limits<double>::infinity());
      EXPECT_EQ(bound.box(node).high[axis], std::numeric_limits<double>::infinity());
    }
}

TEST(Motion_bound, the_common_box_of_two_is_where_both_are) {
  const Aabb a{.low = {0, 0, 0, 0}, .high = {2, 2, 2, 0}}, b{.low = {1, -1, 0, 0}, .high = {3, 1, 2, 0}};
  EXPECT_EQ(common_box(a, b), (Aabb{.low = {1, 0, 0, 0}, .high = {2, 1, 2, 0}}));
}

}  // namespace
}  // namespace lodestone
