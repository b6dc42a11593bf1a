// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes from a promise about distances.
#include "lodestone/bounds/lipschitz_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bounds/given_object.h"
#include "lodestone/io/motion/deformed_points.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/queries/bounded_search.h"
#include "support/exact_truth.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

static_assert(Motion_bound<Lipschitz_bound> && !Watching_bound<Lipschitz_bound>);
static_assert(Motion_promise<Lipschitz_promise>);

std::vector<Point> points_of(const Face_soup& soup) {
  std::vector<Point> points;
  for (std::uint32_t v = 0; v < soup.vertex_count(); ++v) points.push_back(soup.point(v));
  return points;
}

/// A shape, its deformed positions, and the mesh that has them.
struct Deformed_object : Given_object {
  Surface_mesh mesh;
  Deformed_points points;

  Deformed_object(const Surface_mesh& shape, const std::vector<Deformation>& deformations)
      : Given_object(shape), mesh(shape), points(points_of(rest), deformations) {}

  void set_frame(double frame) {
    points.set_frame(frame);
    for (std::uint32_t v = 0; v < vertex_count(); ++v) put(v, points(v));
    for (const auto v : mesh.vertices()) mesh.point(v) = Point(now[3 * v], now[3 * v + 1], now[3 * v + 2]);
  }
};

TEST(Lipschitz_bound, every_vertex_lies_in_the_boxes_of_its_nodes) {
  Deformed_object ball(potato(9), {Inflate{.factor = 3, .frames = 10}, Spin{.degrees_per_frame = 33}});
  Lipschitz_promise promise;
  const Lipschitz_bound bound = promise.bound(ball.bounded());
  ASSERT_EQ(bound.node_count(), ball.layout.node_count());
  for (const double frame : {0.0, 1.0, 5.0, 20.0}) {
    ball.set_frame(frame);
    promise.set_constant((1 + 0.2 * std::min(frame, 10.0)) * (1 + 1e-12));
    EXPECT_EQ(nodes_outside(bound, ball), 0U) << frame;
    EXPECT_LT(bound.box(0).extent(), 3 * ball.fitted_node(0).extent());
  }
}

/// Each vertex moves straight away from the anchor of its node, as far as the promise allows.
TEST(Lipschitz_bound, boxes_are_no_larger_than_the_promise) {
  Given_object object(grid(9, 9), 128);  // one node, with its anchor in the middle, 4 along each axis
  Lipschitz_promise promise(2);
  const Lipschitz_bound bound = promise.bound(object.bounded());
  object.pose([](const Eigen::Vector3d& p) { return Eigen::Vector3d(2 * p); });
  EXPECT_EQ(nodes_outside(bound, object), 0U);
  EXPECT_NEAR(bound.box(0).high[0], 8 + 2 * 4 * std::sqrt(2), 1e-7);
  EXPECT_NEAR(bound.box(0).low[2], -2 * 4 * std::sqrt(2), 1e-7);
}

/// A small shape far away is turned and brought to the origin, where it is as rough as its coordinates were there.
TEST(Lipschitz_bound, every_vertex_lies_in_its_boxes_if_the_error_of_positions_is_promised) {
  std::mt19937_64 random(1);
  std::size_t outside_without = 0;
  for (int round = 0; round < 50; ++round) {
    const double far = std::ldexp(1.0, static_cast<int>(random() % 30));
    Given_object object(placed(potato(4, 1 + random() % 9), std::ldexp(1.0, -20), far), 2 + random() % 20);
    const Eigen::Isometry3d frame = random_frame(random, 0) * Eigen::Translation3d(Eigen::Vector3d::Constant(-far));
    object.pose([&](const Eigen::Vector3d& p) { return frame * p; });
    Lipschitz_promise promise(1);
    const Lipschitz_bound bound = promise.bound(object.bounded());
    outside_without += nodes_outside(bound, object);
    promise.set_constant(1, 32 * 0x1p-53 * far);
    EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
  }
  EXPECT_GT(outside_without, 0U);
}

TEST(Lipschitz_bound, of_a_constant_of_0_is_a_point) {
  Given_object object(potato(3), 8);
  const Lipschitz_promise promise(0);
  const Lipschitz_bound bound = promise.bound(object.bounded());
  object.pose([](const Eigen::Vector3d&) { return Eigen::Vector3d(1, 2, 3); });
  EXPECT_EQ(nodes_outside(bound, object), 0U);
  EXPECT_LT(bound.box(0).extent(), 1e-14);
}

TEST(Lipschitz_bound, of_nothing_promised_is_open) {
  Given_object object(potato(3), 8);
  Lipschitz_promise promise(std::numeric_limits<double>::infinity());
  const Lipschitz_bound bound = promise.bound(object.bounded());
  EXPECT_EQ(bound.box(0), open_box);
  promise.set_constant(0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(bound.box(0), open_box);
}

TEST(Lipschitz_bound, that_is_broken_is_noticed_where_surfaces_meet) {
  Deformed_object a(potato(8, 1), {Inflate{.factor = 1.5, .frames = 10}}),
      b(potato(8, 2), {Travel{.way_points = {{0, {2.6, 0, 0}}}}});
  const Lipschitz_promise promise(1);
  Lipschitz_bound bound_a = promise.bound(a.bounded()), bound_b = promise.bound(b.bounded());
  const auto surface_a = a.surface(bound_a), surface_b = b.surface(bound_b);
  Bounded_search search;
  std::size_t broken = 0;
  for (const double frame : {0.0, 4.0, 10.0}) {
    a.set_frame(frame);
    b.set_frame(frame);
    std::vector<Face_pair> found;
    search.run(*surface_a, *surface_b, {}, found);
    EXPECT_EQ(found, exhaustive_face_pairs(a.mesh, b.mesh)) << frame;
    EXPECT_EQ(surface_b->violations(), 0U);
    broken += surface_a->violations();
  }
  EXPECT_GT(broken, 0U);
}

TEST(Lipschitz_promise, refuses_what_is_no_constant) {
  Given_object object(potato(3));
  Lipschitz_promise promise(2);
  const Lipschitz_bound bound = promise.bound(object.bounded());
  const Aabb before = bound.box(0);
  EXPECT_THROW(promise.set_constant(-1), Bad_argument);
  EXPECT_THROW(promise.set_constant(std::nan("")), Bad_argument);
  EXPECT_THROW(promise.set_constant(1, -1), Bad_argument);
  EXPECT_THROW(promise.set_constant(1, std::nan("")), Bad_argument);
  EXPECT_EQ(bound.box(0), before);
}

TEST(Bounded_object, of_unequal_parts_is_refused) {
  Given_object object(potato(3)), other(potato(4));
  const Lipschitz_promise promise;
  const std::vector<Region_index> labels(7, 0);
  EXPECT_THROW(promise.bound({other.layout, {}, object.rest.coordinates, object.positions}), Bad_argument);
  EXPECT_THROW(promise.bound({object.layout, {}, other.rest.coordinates, object.positions}), Bad_argument);
  EXPECT_THROW(promise.bound({object.layout, labels, object.rest.coordinates, object.positions}), Bad_argument);
}

Deformation random_deformation(std::mt19937_64& random, double size) {
  const auto number = [&](double low, double high) { return random_number(random, low, high); };
  const auto direction = [&] {
    const Eigen::Vector3d v = random_direction(random);
    return Kernel::Vector_3(v.x(), v.y(), v.z());
  };
  switch (random() % 6) {
    case 0:
      return Wobble{.amplitude = number(-0.5, 0.5), .waves = number(-3, 3), .period = number(0, 30)};
    case 1:
      return Bend{.axis = direction(), .towards = direction(), .degrees = number(-400, 400), .period = number(0, 30)};
    case 2:
      return Twist{.axis = direction(), .degrees = number(-400, 400), .period = number(0, 30)};
    case 3:
      return Inflate{.factor = number(0.1, 5), .frames = number(1, 60)};
    case 4:
      return Travel{.way_points = {{0, 5 * size * direction()}, {60, 5 * size * direction()}}};
    default:
      return Spin{.axis = direction(), .degrees_per_frame = number(-90, 90)};
  }
}

/// How far two vertices are apart, in comparison with rest; an error allowed.
double greatest_ratio(const Deformed_object& object, double error) {
  double most = 0;
  for (std::uint32_t v = 0; v < object.vertex_count(); ++v)
    for (std::uint32_t w = 0; w < v; ++w) {
      const double now = (object.at(object.now, v) - object.at(object.now, w)).norm() - 2 * error;
      const double then = (object.at_rest(v) - object.at_rest(w)).norm();
      if (now > 0) most = std::max(most, now / then);
    }
  return most;
}

TEST(Deformed_points, no_two_vertices_are_farther_apart_than_their_constant_says) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 150; ++round) {
    const double size = std::ldexp(1.0, static_cast<int>(random() % 20) - 10);
    std::vector<Deformation> deformations(1 + random() % 4);
    for (auto& deformation : deformations) deformation = random_deformation(random, size);
    const double far = round % 3 == 0 ? size * std::ldexp(1.0, static_cast<int>(random() % 40)) : 0;
    Surface_mesh shape = potato(3, 1 + random() % 9);
    deform(shape, [&](const Point& p) { return Point(far + size * p.x(), size * p.y(), 3 * size * p.z()); });
    Deformed_object object(shape, deformations);
    for (const double frame : {0.0, random_number(random, 0, 60)}) {
      object.set_frame(frame);
      const double error = object.points.position_error();
      EXPECT_LE(greatest_ratio(object, error), object.points.lipschitz_constant() * (1 + 1e-13)) << round;
      EXPECT_LT(error, 1e-12 * object.points.lipschitz_constant() * (far + 100 * size)) << round;
      const Lipschitz_promise promise(object.points.lipschitz_constant(), error);
      EXPECT_EQ(nodes_outside(promise.bound(object.bounded()), object), 0U) << round;
    }
  }
}

/// A flat sheet leaves its plane, or moves away from the axis, before it is bent or twisted.
TEST(Deformed_points, their_constant_knows_where_earlier_deformations_have_put_the_shape) {
  const std::vector<Deformation> first{Wobble{.amplitude = 0.7, .waves = 0, .period = 0, .phase = 0.3},
                                       Wobble{.amplitude = 0.7, .waves = 0, .period = 0, .phase = 0.8},
                                       Travel{.way_points = {{0, {4, 5, 6}}}},
                                       Travel{.way_points = {{0, {4, 5, -6}}}},
                                       Inflate{.factor = 5, .frames = 1},
                                       Spin{.axis = {1, 0, 0}, .degrees_per_frame = 90},
                                       Twist{.axis = {1, 0, 0}, .degrees = 170, .period = 0},
                                       Bend{.axis = {0, 1, 0}, .towards = {0, 0, 1}, .degrees = 120, .period = 0},
                                       Bend{.axis = {0, 1, 0}, .towards = {0, 0, 1}, .degrees = -120, .period = 0}};
  const std::vector<Deformation> second{Bend{.axis = {1, 0, 0}, .towards = {0, 0, 1}, .degrees = 90, .period = 0},
                                        Twist{.axis = {1, 0, 0}, .degrees = 200, .period = 0}};
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j) {
      Deformed_object object(grid(12, 12), {first[i], second[j]});
      object.set_frame(1);
      EXPECT_LE(greatest_ratio(object, object.points.position_error()),
                object.points.lipschitz_constant() * (1 + 1e-13))
          << i << ' ' << j;
    }
}

/// A fine shape, so that some edge lies where the derivative is largest, and along the direction of largest stretch.
TEST(Deformed_points, their_constant_is_hardly_larger_than_needed_after_one_deformation) {
  std::mt19937_64 random(4);
  const auto looseness = [&](const Deformation& deformation) {
    Deformed_object object(potato(24), {deformation});
    object.set_frame(10);
    return object.points.lipschitz_constant() / greatest_ratio(object, 0);
  };
  EXPECT_LT(looseness(Inflate{.factor = 3, .frames = 10}), 1 + 1e-6);
  EXPECT_LT(looseness(Travel{.way_points = {{0, {1, 2, 3}}}}), 1 + 1e-6);
  EXPECT_LT(looseness(Spin{.degrees_per_frame = 7}), 1 + 1e-6);
  EXPECT_LT(looseness(Wobble{.amplitude = 0.1, .waves = 1}), 1.25);
  EXPECT_LT(looseness(Bend{.degrees = 60, .period = 0}), 1.25);
  EXPECT_LT(looseness(Twist{.degrees = 60, .period = 0}), 1.25);
}

TEST(Deformed_points, their_constant_is_that_of_the_current_frame) {
  Deformed_object object(potato(3), {Inflate{.factor = 3, .frames = 10}, Spin{}});
  EXPECT_NEAR(object.points.lipschitz_constant(), 1, 1e-11);
  object.set_frame(5);
  EXPECT_NEAR(object.points.lipschitz_constant(), 2, 1e-11);
  object.set_frame(50);
  EXPECT_NEAR(object.points.lipschitz_constant(), 3, 1e-11);
  const Deformed_points still(points_of(object.rest), {});
  EXPECT_EQ(still.lipschitz_constant(), 1);
  EXPECT_EQ(still.position_error(), 0);
  const Deformed_points wild(points_of(object.rest), {Wobble{.amplitude = 1e300, .waves = 1e300}});
  EXPECT_EQ(wild.lipschitz_constant(), std::numeric_limits<double>::infinity());
}

TEST(Lipschitz_bound, contains_errors_both_ways) {
  Lipschitz_promise promise(1);
  promise.set_constant(1, 10);
  expect_inside_off_both_ways(promise);
}

TEST(Lipschitz_bound, contains_the_smallest_numbers) {
  Given_object object(potato(3), 4);
  object.pose([](const Eigen::Vector3d& p) { return Eigen::Vector3d(1e-320 * p); });
  const auto tiny = object.now;
  object.rest.coordinates = tiny;
  const Lipschitz_promise promise(1);
  EXPECT_EQ(nodes_outside(promise.bound(object.bounded()), object), 0U);
}

}  // namespace
}  // namespace lodestone
