// SPDX-License-Identifier: GPL-3.0-or-later
// Positions that are computed when they are read: the same bits from every function, and right.
#include "lodestone/mesh/computed_points.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <random>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/live_positions.h"
#include "lodestone/mesh/skinned_points.h"
#include "support/instruction_sets.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

static_assert(Computed_points<Morphed_points> && Computed_points<Skinned_points>);
static_assert(Vertex_point_map<Computed_point_map<Surface_mesh, Skinned_points>, Surface_mesh>);

double number(std::mt19937_64& random, double low = -1, double high = 1) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
std::vector<double> numbers(std::size_t count, std::mt19937_64& random) {
  std::vector<double> list(count);
  for (double& x : list) x = number(random);
  return list;
}

/// Dense, sparse, with zeros, and empty.
std::vector<Morph_target> some_targets(std::uint32_t vertices, std::mt19937_64& random) {
  std::vector<Morph_target> targets(5);
  targets[0].offsets = numbers(3 * vertices, random);
  targets[1].offsets = numbers(3 * vertices, random);
  for (std::size_t i = 0; i < targets[1].offsets.size(); ++i)
    if (i / 3 % 7 != 0) targets[1].offsets[i] = 0;
  for (std::uint32_t v = 3; v < vertices; v += 1 + static_cast<std::uint32_t>(random() % 100))
    targets[2].vertices.push_back(v);
  targets[2].offsets = numbers(3 * targets[2].vertices.size(), random);
  targets[4].vertices = {vertices - 1};
  targets[4].offsets = {1, 2, 3};
  return targets;
}

/// From one joint to all; some joints several times, some weights 0, others not normalised.
Joint_influences some_influences(std::uint32_t vertices, std::size_t joints, std::mt19937_64& random) {
  Joint_influences influences;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const std::size_t count = 1 + random() % joints;
    for (std::size_t i = 0; i < count; ++i) {
      influences.joints.push_back(static_cast<std::uint32_t>(random() % joints));
      influences.weights.push_back(i > 0 && random() % 3 == 0 ? 0 : number(random, 0.01, 3));
    }
    influences.begin.push_back(static_cast<std::uint32_t>(influences.joints.size()));
  }
  return influences;
}

std::vector<Eigen::Affine3d> some_motions(std::size_t joints, std::mt19937_64& random) {
  std::vector<Eigen::Affine3d> motions(joints);
  for (auto& motion : motions)
    for (Eigen::Index row = 0; row < 3; ++row)
      for (Eigen::Index column = 0; column < 4; ++column) motion(row, column) = number(random, -2, 2);
  return motions;
}

/// All positions, after checking that every way to compute them gives the same bits.
template <Computed_points Points>
std::vector<double> expect_one_truth(const Points& points, std::mt19937_64& random) {
  const std::uint32_t count = points.vertex_count();
  std::vector<double> all(3 * std::size_t{count}, not_a_number), listed = all, single = all;
  points.pose_all(all);
  std::vector<std::uint32_t> list(count);
  std::iota(list.begin(), list.end(), 0U);
  std::ranges::shuffle(list, random);
  points.pose(std::span(list).first(count / 2), listed);
  for (const auto v : std::span(list).subspan(count / 2)) {
    EXPECT_TRUE(std::isnan(listed[3 * v]) && std::isnan(listed[3 * v + 2]));  // not in the list
    Eigen::Map<Eigen::Vector3d>(listed.data() + 3 * std::size_t{v}) = points(v);
  }
  EXPECT_EQ(listed, all);
  return all;
}

Skinned_points some_skinned_points(std::uint32_t vertices, bool morphed, std::mt19937_64& random) {
  const auto targets = morphed ? some_targets(vertices, random) : std::vector<Morph_target>();
  Skinned_points points(Morphed_points(numbers(3 * vertices, random), targets), some_influences(vertices, 9, random),
                        9);
  if (morphed) points.set_weights(std::vector<double>{0.3, -2, 1, 5, 0});
  points.set_joints(some_motions(9, random));
  return points;
}

TEST(Computed_points, come_out_with_the_same_bits_however_they_are_computed) {
  std::mt19937_64 random(1);
  for (const std::uint32_t vertices : {1U, 2U, 63U, 64U, 65U, 1000U})
    for (const bool morphed : {false, true}) {
      const auto points = some_skinned_points(vertices, morphed, random);
      expect_one_truth(points, random);
      expect_one_truth(points.shape(), random);
    }
}

TEST(Computed_points, come_out_with_the_same_bits_on_all_instruction_sets) {
  for (const bool morphed : {false, true}) {
    std::vector<double> first;
    for_instruction_sets([&] {
      std::mt19937_64 random(2);
      const auto all = expect_one_truth(some_skinned_points(333, morphed, random), random);
      if (first.empty()) first = all;
      EXPECT_EQ(all, first);
    });
  }
}

TEST(Morphed_points, are_the_sum_of_weighted_offsets) {
  std::mt19937_64 random(3);
  const std::uint32_t count = 500;
  const auto rest = numbers(3 * count, random);
  const auto targets = some_targets(count, random);
  Morphed_points points(rest, targets);
  EXPECT_EQ(expect_one_truth(points, random), rest);  // all weights are 0
  for (const std::vector<double>& weights :
       {std::vector<double>{1, 0, 0, 0, 0}, {0, 0.5, 0, 1, -3}, {-1, 2, 0.25, 1, 1e-3}}) {
    points.set_weights(weights);
    auto expected = rest;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const auto& [vertices, offsets] = targets[t];
      for (std::size_t i = 0; i < offsets.size(); ++i)
        expected[vertices.empty() ? i : 3 * vertices[i / 3] + i % 3] += weights[t] * offsets[i];
    }
    EXPECT_EQ(expect_one_truth(points, random), expected);
  }
}

TEST(Skinned_points, are_blended_from_their_joints) {
  std::mt19937_64 random(4);
  const std::uint32_t count = 300;
  const std::size_t joints = 7;
  const auto rest = numbers(3 * count, random);
  const auto influences = some_influences(count, joints, random);
  Skinned_points points(rest, influences, joints);
  const auto unmoved = expect_one_truth(points, random);
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(unmoved[i], rest[i], 1e-15);
  const auto motions = some_motions(joints, random);
  points.set_joints(motions);
  const auto all = expect_one_truth(points, random);
  for (std::uint32_t v = 0; v < count; ++v) {
    const Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3d>(rest.data() + 3 * v);
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    double sum = 0;
    for (std::uint32_t i = influences.begin[v]; i < influences.begin[v + 1]; ++i) {
      expected += influences.weights[i] * (motions[influences.joints[i]] * at);
      sum += influences.weights[i];
    }
    EXPECT_LT((Eigen::Map<const Eigen::Vector3d>(all.data() + 3 * v) - expected / sum).norm(), 1e-14);
  }
}

TEST(Skinned_points, that_follow_one_joint_are_where_it_takes_them) {
  const std::vector<double> rest{1, 2, 3, -4, 5, 0.5};
  Skinned_points points(rest, Joint_influences::of(1, std::vector<std::uint32_t>{1, 0}, std::vector<double>{0.25, 8}),
                        2);
  Eigen::Affine3d turned = Eigen::Affine3d::Identity();
  turned.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 2;
  turned.translation() << 10, 20, 30;
  points.set_joints(std::vector{Eigen::Affine3d::Identity(), turned});
  std::vector<double> all(6);
  points.pose_all(all);
  EXPECT_EQ(all, (std::vector<double>{8, 21, 36, -4, 5, 0.5}));
}

TEST(Joint_influences, of_files_leave_out_joints_without_weight) {
  const auto influences =
      Joint_influences::of(3, std::vector<std::uint32_t>{5, 6, 7, 8, 9, 1}, std::vector<double>{0, 0.5, 0.5, 1, 0, 0});
  EXPECT_EQ(influences.begin, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(influences.joints, (std::vector<std::uint32_t>{6, 7, 8}));
  EXPECT_EQ(influences.weights, (std::vector<double>{0.5, 0.5, 1}));
}

template <class Mesh>
class Point_map : public testing::Test {};
using Meshes = testing::Types<Surface_mesh, CGAL::Polyhedron_3<Kernel>,
                              CGAL::Polyhedron_3<Kernel, CGAL::Polyhedron_items_with_id_3>>;
TYPED_TEST_SUITE(Point_map, Meshes);

TYPED_TEST(Point_map, gives_each_vertex_its_point) {
  TypeParam mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  std::mt19937_64 random(6);
  auto points = some_skinned_points(12, true, random);
  const auto map = point_map(mesh, points);
  Mesh_numbering<TypeParam> numbering(mesh);
  Coordinate_reader<TypeParam, std::decay_t<decltype(map)>> reader(map);
  static_assert(!decltype(reader)::in_memory);
  for (int pose = 0; pose < 2; ++pose) {
    const Coordinates all = reader.read(numbering);
    ASSERT_EQ(all.size(), 36U);
    std::uint32_t index = 0;
    for (const auto v : vertices(mesh)) {
      const Eigen::Vector3d expected = points(index++);
      const Point read = get(map, v);
      EXPECT_EQ(Eigen::Vector3d(read.x(), read.y(), read.z()), expected);
    }
    for (std::uint32_t i = 0; i < 12; ++i) {
      const Point read = get(map, numbering.vertex(i));
      EXPECT_EQ(Point(all[3 * i], all[3 * i + 1], all[3 * i + 2]), read);
    }
    points.set_joints(some_motions(9, random));
  }
}

TEST(Point_map, of_fewer_points_than_vertices_is_refused) {
  Surface_mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  const Morphed_points points(std::vector<double>(33, 1));
  Coordinate_reader<Surface_mesh, Computed_point_map<Surface_mesh, Morphed_points>> reader(point_map(mesh, points));
  EXPECT_THROW(reader.read(Mesh_numbering<Surface_mesh>(mesh)), Bad_argument);
}

TEST(Computed_points, bad_input_is_refused_and_changes_nothing) {
  const std::vector<double> rest(9, 1);
  const auto morphed = [&](const Morph_target& target) {
    return message_of<Bad_argument>([&] { Morphed_points(rest, std::vector{Morph_target(), target}); });
  };
  EXPECT_EQ(message_of<Bad_argument>([] {
              Morphed_points({1, 2});
            }),
            "2 coordinates at rest, expected three for each vertex");
  EXPECT_EQ(message_of<Bad_argument>([] {
              Morphed_points({1, 2, not_a_number});
            }),
            "a coordinate at rest is not finite");
  EXPECT_EQ(morphed({.vertices = {0, 1}, .offsets = {1, 2, 3}}),
            "morph target 1: it has 3 numbers for 2 vertices, expected three for each");
  EXPECT_EQ(morphed({.vertices = {}, .offsets = {1, 2, 3}}),
            "morph target 1: it has 3 numbers for 3 vertices, expected three for each");
  EXPECT_EQ(morphed({.vertices = {1, 0}, .offsets = {1, 2, 3, 4, 5, 6}}), "morph target 1: its vertices do not ascend");
  EXPECT_EQ(morphed({.vertices = {1, 1}, .offsets = {1, 2, 3, 4, 5, 6}}), "morph target 1: its vertices do not ascend");
  EXPECT_EQ(morphed({.vertices = {3}, .offsets = {1, 2, 3}}), "morph target 1: it moves vertex 3 of 3");
  EXPECT_EQ(morphed({.vertices = {0}, .offsets = {1, infinity, 3}}), "morph target 1: an offset is not finite");

  const auto skinned = [&](Joint_influences influences) {
    return message_of<Bad_argument>([&] { Skinned_points(rest, influences, 2); });
  };
  EXPECT_EQ(skinned({.begin = {0, 1, 2, 3}, .joints = {0, 1, 2}, .weights = {1, 1, 1}}),
            "vertex 2 follows joint 2 of 2");
  EXPECT_EQ(skinned({.begin = {0, 1, 2, 3}, .joints = {0, 1, 1}, .weights = {1, -1, 1}}),
            "vertex 1 has the weight -1 of a joint, must be >= 0 and finite");
  EXPECT_EQ(skinned({.begin = {0, 1, 2, 3}, .joints = {0, 1, 1}, .weights = {0, 1, 1}}),
            "the weights of vertex 0 have the sum 0, must be > 0 and finite");
  EXPECT_EQ(skinned({.begin = {0, 1, 1, 3}, .joints = {0, 1, 1}, .weights = {1, 1, 1}}),
            "the weights of vertex 1 have the sum 0, must be > 0 and finite");
  for (const Joint_influences& influences :
       {Joint_influences{.begin = {0, 1, 2}, .joints = {0, 1}, .weights = {1, 1}},
        Joint_influences{.begin = {0, 2, 1, 3}, .joints = {0, 1, 1}, .weights = {1, 1, 1}},
        Joint_influences{.begin = {0, 1, 2, 3}, .joints = {0, 1, 1}, .weights = {1, 1}},
        Joint_influences{.begin = {0, 1, 2, 3}, .joints = {0, 1, 1, 1}, .weights = {1, 1, 1, 1}}})
    EXPECT_EQ(skinned(influences), "the lists of joints and weights do not fit 3 vertices");
  EXPECT_EQ(message_of<Bad_argument>([] {
              Joint_influences::of(2, std::vector<std::uint32_t>{0, 1, 2}, std::vector<double>{1, 1, 1});
            }),
            "3 joints and 3 weights, expected 2 of both for each vertex");

  std::mt19937_64 random(7);
  auto points = some_skinned_points(10, true, random);
  std::vector<double> before(30), after(30);
  points.pose_all(before);
  const auto number_before = points.pose_number();
  EXPECT_EQ(message_of<Bad_argument>([&] { points.set_weights(std::vector<double>{1}); }),
            "1 weights for 5 morph targets");
  EXPECT_EQ(message_of<Bad_argument>([&] {
              points.set_weights(std::vector<double>{1, 1, not_a_number, 1, 1});
            }),
            "the weight of a morph target is not finite");
  EXPECT_EQ(message_of<Bad_argument>([&] { points.set_joints(some_motions(3, random)); }),
            "the motions of 3 joints for a skin of 9");
  auto motions = some_motions(9, random);
  motions[4](1, 3) = infinity;
  EXPECT_EQ(message_of<Bad_argument>([&] { points.set_joints(motions); }),
            "the motion of joint 4 has a number that is not finite");
  points.pose_all(after);
  EXPECT_EQ(after, before);
  EXPECT_EQ(points.pose_number(), number_before);
}

}  // namespace
}  // namespace lodestone
