// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes from a promise about how far vertices have moved.
#include "lodestone/bounds/displacement_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bounds/given_object.h"
#include "lodestone/bounds/node_regions.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/queries/bounded_search.h"
#include "lodestone/tree/region_tree.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

static_assert(All_watching_bound<Displacement_bound> && Motion_promise<Displacement_promise>);

/// Coordinates that are multiples of 2^-20, so that adding such numbers is exact.
Face_soup on_lattice(Face_soup soup, double offset = 0) {
  for (double& x : soup.coordinates) x = offset + std::ldexp(std::round(std::ldexp(x, 20)), -20);
  return soup;
}

double lattice_number(std::mt19937_64& random, double high) {
  return std::ldexp(std::floor(std::ldexp(random_number(random, 0, high), 20)), -20);
}

/// Moves a vertex by exactly this distance, along an axis.
void step(std::vector<double>& coordinates, std::uint32_t vertex, double distance, std::mt19937_64& random) {
  coordinates[3 * std::size_t{vertex} + random() % 3] += random() % 2 == 0 ? distance : -distance;
}

void read_leaf(Displacement_bound& bound, const Given_object& object, std::uint32_t leaf) {
  EXPECT_TRUE(bound.note_read(leaf, object.fitted(leaf), object.now));
}

void read_some_leaves(Displacement_bound& bound, const Given_object& object, std::mt19937_64& random) {
  for (auto count = random() % 4; count > 0; --count)
    read_leaf(bound, object, static_cast<std::uint32_t>(random() % object.layout.leaf_count()));
}

TEST(Displacement_bound, every_vertex_lies_in_the_boxes_of_its_nodes) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 60; ++round) {
    Given_object object(on_lattice(potato(2 + random() % 4), round % 2 == 0 ? 0 : 1e9), 2 + random() % 20);
    Displacement_promise promise;
    if (round % 3 == 0) promise.move(lattice_number(random, 5));  // before the bound
    Displacement_bound bound = promise.bound(object.bounded());
    ASSERT_EQ(bound.node_count(), object.layout.node_count());
    for (int frame = 0; frame < 12; ++frame) {
      EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
      read_some_leaves(bound, object, random);
      EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
      const double distance = frame % 5 == 4 ? 0 : lattice_number(random, 0.3);
      for (std::uint32_t v = 0; v < object.vertex_count(); ++v) step(object.now, v, distance, random);
      promise.move(distance);
    }
  }
}

TEST(Displacement_bound, every_vertex_lies_in_the_boxes_of_its_nodes_if_regions_move_by_different_distances) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 40; ++round) {
    const Face_soup soup = on_lattice(potato(3 + random() % 4));
    Given_object object(soup, 2 + random() % 20, octants(soup));
    Displacement_promise promise(8);
    Displacement_bound bound = promise.bound(object.bounded());
    for (int frame = 0; frame < 12; ++frame) {
      std::vector<double> distances(8, 0);
      for (double& distance : distances)
        if (random() % 2 == 0) distance = lattice_number(random, 0.3);
      for (std::uint32_t v = 0; v < object.vertex_count(); ++v)
        step(object.now, v, distances[object.labels[v]], random);
      promise.move(distances);
      EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
      read_some_leaves(bound, object, random);
      EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
    }
  }
}

/// The positions q are in the frame, and those of the object are frame * q as it is rounded.
TEST(Displacement_bound, every_vertex_lies_in_the_boxes_of_its_nodes_in_a_rigid_frame) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 80; ++round) {
    Given_object object(on_lattice(potato(2 + random() % 4)), 2 + random() % 20);
    auto q = object.rest.coordinates;
    const double far = std::ldexp(1.0, static_cast<int>(random() % 40) - 10);
    Displacement_promise promise;
    Displacement_bound bound = promise.bound(object.bounded());
    for (int frame = 0; frame < 12; ++frame) {
      const double distance = frame % 3 == 0 ? 0 : lattice_number(random, 0.1);
      for (std::uint32_t v = 0; v < object.vertex_count(); ++v) step(q, v, distance, random);
      Eigen::Isometry3d pose = frame % 4 == 3 ? Eigen::Isometry3d::Identity() : random_frame(random, far);
      if (round % 2 == 1)  // a frame that has been multiplied for long: no longer quite a rotation
        for (auto& entry : pose.linear().reshaped()) entry += 1e-7 * random_number(random);
      for (std::uint32_t v = 0; v < object.vertex_count(); ++v) object.put(v, pose * object.at(q, v));
      promise.move(distance, pose);
      EXPECT_EQ(nodes_outside(bound, object), 0U) << round << ' ' << frame;
      read_some_leaves(bound, object, random);
      EXPECT_EQ(nodes_outside(bound, object), 0U) << round << ' ' << frame;
    }
  }
}

TEST(Displacement_bound, made_in_a_frame_starts_there) {
  std::mt19937_64 random(4);
  Given_object object(potato(5));
  const auto pose = random_frame(random, 7);
  Displacement_promise promise;
  promise.move(0, pose);
  const Displacement_bound bound = promise.bound(object.bounded());
  EXPECT_EQ(nodes_outside(bound, object), 0U);
  promise.move(0, Eigen::Isometry3d::Identity());
  for (std::uint32_t v = 0; v < object.vertex_count(); ++v) object.put(v, pose.inverse() * object.at_rest(v));
  for (std::uint32_t node = 0; node < bound.node_count(); ++node)  // the inverse is rounded too
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LT(bound.box(node).low[axis], object.fitted_node(node).low[axis] + 1e-14);
      EXPECT_GT(bound.box(node).low[axis], object.fitted_node(node).low[axis] - 1e-12);
    }
}

TEST(Displacement_bound, of_a_leaf_that_is_not_read_grows_by_what_was_promised) {
  Given_object object(potato(8));
  Displacement_promise promise;
  const Displacement_bound bound = promise.bound(object.bounded());
  const Aabb rest = object.fitted(3);
  EXPECT_EQ(bound.box(object.layout.leaf_node(3)), rest);
  for (int frame = 0; frame < 10; ++frame) promise.move(0.1);
  const Aabb box = bound.box(object.layout.leaf_node(3));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.low[axis], rest.low[axis] - 1, 1e-14);
    EXPECT_NEAR(box.high[axis], rest.high[axis] + 1, 1e-14);
  }
}

TEST(Displacement_bound, every_vertex_lies_in_its_boxes_if_distances_are_too_small_to_change_their_rounded_sum) {
  std::mt19937_64 random(7);
  Given_object object(placed(on_lattice(potato(4)), std::ldexp(1.0, -70)));
  Displacement_promise promise;
  promise.move(1);
  const Displacement_bound bound = promise.bound(object.bounded());
  for (int frame = 0; frame < 5; ++frame) {
    const double distance = std::ldexp(1.0, -71);
    for (std::uint32_t v = 0; v < object.vertex_count(); ++v) step(object.now, v, distance, random);
    promise.move(distance);
    EXPECT_EQ(nodes_outside(bound, object), 0U);
  }
}

TEST(Displacement_bound, is_tight_where_leaves_are_read_and_above_them) {
  Given_object object(potato(8));
  Displacement_promise promise;
  Displacement_bound bound = promise.bound(object.bounded());
  const auto& layout = object.layout;
  promise.move(0.5);
  read_leaf(bound, object, 4);
  EXPECT_EQ(bound.box(layout.leaf_node(4)), object.fitted(4));
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf) read_leaf(bound, object, leaf);
  for (std::uint32_t node = 0; node < layout.node_count(); ++node)
    EXPECT_EQ(bound.box(node), object.fitted_node(node)) << node;
  promise.move(0.25);
  EXPECT_NEAR(bound.box(0).high[0], object.fitted_node(0).high[0] + 0.25, 1e-15);
}

TEST(Displacement_bound, grows_only_where_a_region_has_moved) {
  const Face_soup soup(potato(8));
  Given_object object(soup, 6, octants(soup));
  Displacement_promise promise(8);
  const Displacement_bound bound = promise.bound(object.bounded());
  promise.move(std::vector<double>{0, 0, 0.5, 0, 0, 0, 0, 0});
  promise.move(std::vector<double>{0, 0, 0.5, 0, 0, 0.25, 0, 0});
  const auto regions = node_regions(object.layout, object.labels);
  std::size_t still = 0;
  for (std::uint32_t node = 0; node < bound.node_count(); ++node) {
    const double by = bound.box(node).high[1] - object.fitted_node(node).high[1];
    const auto region = regions[node];
    EXPECT_NEAR(by, region == 2 || region == several_regions ? 1 : region == 5 ? 0.25 : 0, 1e-14);
    still += by == 0 ? 1 : 0;
  }
  EXPECT_GT(still, 10U);
}

/// Without a frame, the promised distance would be twice the radius in a few frames.
TEST(Displacement_bound, of_a_body_that_spins_in_its_frame_stays_nearly_as_tight_as_at_rest) {
  Given_object object(potato(8));
  Displacement_promise promise;
  Displacement_bound bound = promise.bound(object.bounded());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int frame = 0; frame < 200; ++frame) {
    pose = Eigen::Translation3d(0.5, 0.2, 0) * Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.6, 0, 0.8)) * pose;
    object.pose([&](const Eigen::Vector3d& p) { return pose * p; });
    promise.move(1e-6, pose);
    double loosest = 0;
    for (std::uint32_t node = 0; node < bound.node_count(); ++node)
      loosest = std::max(loosest, bound.box(node).extent() / object.fitted_node(node).extent());
    // A turned box is in a box whose sides are at most sqrt(3) times as long; here fitted ones turn, which cut corners.
    ASSERT_LT(loosest, 2.5);
    ASSERT_EQ(nodes_outside(bound, object), 0U);
    read_leaf(bound, object, static_cast<std::uint32_t>(frame) % 5);
  }
}

TEST(Displacement_bound, that_is_broken_is_noticed_and_right_again_after_the_surface_has_settled) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 20; ++round) {
    Given_object object(on_lattice(potato(8)));
    Displacement_promise promise;
    Displacement_bound bound = promise.bound(object.bounded());
    const auto surface = object.surface(bound);
    const auto leaf = static_cast<std::uint32_t>(random() % object.layout.leaf_count());
    for (const auto vertex : object.layout.vertices(leaf)) step(object.now, vertex, 0.5, random);
    promise.move(0.25);
    surface->start_frame();
    surface->pose(leaf);
    EXPECT_EQ(surface->violations(), 1U);
    EXPECT_TRUE(surface->is_broken());
    surface->settle();
    EXPECT_FALSE(surface->is_broken());
    for (std::uint32_t node = 0; node < bound.node_count(); ++node)
      EXPECT_EQ(bound.box(node), object.fitted_node(node));
    promise.move(0);
    surface->start_frame();
    surface->pose(leaf);
    EXPECT_EQ(surface->violations(), 0U);
  }
}

TEST(Displacement_bound, contacts_are_those_of_exhaustive_checking) {
  std::mt19937_64 random(6);
  Given_object a(potato(18, 1), 32), b(potato(18, 2), 32);
  Displacement_promise promise_a, promise_b;
  Displacement_bound bound_a = promise_a.bound(a.bounded()), bound_b = promise_b.bound(b.bounded());
  const auto surface_a = a.surface(bound_a), surface_b = b.surface(bound_b, true);
  Bounded_search search;
  std::size_t meetings = 0, posed = 0;
  for (int frame = 0; frame < 120; ++frame) {
    const Eigen::Isometry3d pose = Eigen::Translation3d(2.5 + std::cos(0.3 * frame), 0, 0) *
                                   Eigen::Isometry3d(Eigen::AngleAxisd(frame, Eigen::Vector3d::UnitY()));
    const double swell = 1 + 0.05 * std::sin(0.5 * frame);
    if (frame % 2 == 0) b.now = std::vector<double>(b.now);  // elsewhere in memory
    a.pose([&](const Eigen::Vector3d& p) { return Eigen::Vector3d(swell * p); });
    b.pose([&](const Eigen::Vector3d& p) { return pose * p; });
    promise_a.move(0.05);
    promise_b.move(0, pose);
    std::vector<Face_pair> found;
    search.run(*surface_a, *surface_b, {}, found);
    Face_soup now_a = a.rest, now_b = b.rest;
    now_a.coordinates = a.now;
    now_b.coordinates = b.now;
    EXPECT_EQ(found, true_pairs(now_a, now_b));
    EXPECT_EQ(surface_a->violations() + surface_b->violations(), 0U);
    meetings += found.empty() ? 0 : 1;
    posed += surface_a->all_posed() ? 0 : 1;
  }
  EXPECT_GT(meetings, 10U);
  EXPECT_GT(posed, 10U);
}

std::vector<Aabb> fitted_nodes(const Given_object& object) { return fitted_boxes(object.layout, object.now); }

TEST(Displacement_bound, that_is_shown_all_boxes_has_them) {
  Given_object object(potato(8), 10);
  Displacement_promise promise;
  Displacement_bound bound = promise.bound(object.bounded());
  promise.move(0.7);
  object.pose([](const Eigen::Vector3d& p) { return Eigen::Vector3d(p + Eigen::Vector3d(0.5, 0.1 * p.x(), 0)); });
  EXPECT_TRUE(bound.note_all(fitted_nodes(object), object.now, false));
  for (std::uint32_t node = 0; node < bound.node_count(); ++node) EXPECT_EQ(bound.box(node), object.fitted_node(node));
}

/// Far from the origin too, where the frame rounds most; and in frames to come.
TEST(Displacement_bound, every_vertex_lies_in_its_boxes_after_all_were_shown_in_a_rigid_frame) {
  std::mt19937_64 random(21);
  for (int round = 0; round < 100; ++round) {
    Given_object object(potato(2 + random() % 6), 2 + random() % 20);
    Displacement_promise promise;
    Displacement_bound bound = promise.bound(object.bounded());
    for (int frame = 0; frame < 4; ++frame) {
      const Eigen::Isometry3d pose = random_frame(random, std::pow(10, random_number(random, -2, 9)));
      object.pose([&](const Eigen::Vector3d& p) { return Eigen::Vector3d(pose * p); });
      promise.move(0, pose);
      if (frame % 2 == 0) {
        EXPECT_TRUE(bound.note_all(fitted_nodes(object), object.now, false));
      }
      EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
    }
  }
}

TEST(Bounded_surface, gives_up_when_boxes_alone_take_longer_than_to_read_all) {
  Given_object object(potato(12), 12);
  const Displacement_promise promise;
  Displacement_bound bound = promise.bound(object.bounded());
  const auto surface = object.surface(bound, true);
  std::uint32_t node = 0;
  while (!surface->all_posed() && node < object.layout.node_count()) surface->box(node++);
  ASSERT_TRUE(surface->all_posed());
  EXPECT_GT(surface->nodes_bounded(), 10U);
  EXPECT_LT(surface->nodes_bounded(), object.layout.node_count() / 2);
  EXPECT_EQ(surface->vertices_posed(), object.layout.vertex_begin().back());
}

/// A cube whose faces are turned onto faces, where a box that is turned has nothing to spare.
Face_soup cube_away_from_origin() {
  Surface_mesh mesh = cube(1);
  deform(mesh, [](const Point& p) { return Point(p.x() + 10.1, p.y() + 10.1, p.z() + 10.1); });
  return Face_soup(mesh);
}

TEST(Displacement_bound, that_was_shown_all_allows_for_a_frame_that_is_not_quite_rigid) {
  Given_object object(cube_away_from_origin(), 128);
  ASSERT_EQ(object.layout.leaf_count(), 1U);
  Displacement_promise promise;
  Displacement_bound bound = promise.bound(object.bounded());
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  frame.linear() *= 1 + 1e-7;
  promise.move(0, frame);
  object.pose([&](const Eigen::Vector3d& q) { return Eigen::Vector3d(frame * q); });
  EXPECT_TRUE(bound.note_all(fitted_nodes(object), object.now, false));
  promise.move(0, Eigen::Isometry3d::Identity());
  object.now = object.rest.coordinates;  // q, which has not moved
  EXPECT_EQ(nodes_outside(bound, object), 0U);
}

TEST(Displacement_bound, that_was_shown_all_allows_for_the_rounding_of_positions_far_away) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 50; ++round) {
    Given_object object(cube_away_from_origin(), 128);
    Displacement_promise promise;
    Displacement_bound bound = promise.bound(object.bounded());
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    frame.translation() = 1e9 * random_direction(random);
    promise.move(0, frame);
    object.pose([&](const Eigen::Vector3d& q) { return Eigen::Vector3d(frame * q); });
    EXPECT_TRUE(bound.note_all(fitted_nodes(object), object.now, false));
    promise.move(0, Eigen::Isometry3d::Identity());
    object.now = object.rest.coordinates;
    EXPECT_EQ(nodes_outside(bound, object), 0U);
  }
}

TEST(Displacement_bound, that_overflows_is_open) {
  Given_object object(potato(3));
  Displacement_promise promise;
  const Displacement_bound bound = promise.bound(object.bounded());
  promise.move(1.7e308);
  promise.move(1.7e308);
  EXPECT_EQ(bound.box(0), open_box);
  promise.move(0, Eigen::Isometry3d(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitX())));
  EXPECT_EQ(bound.box(0), open_box);
}

TEST(Displacement_promise, refuses_what_is_no_distance_and_no_rigid_frame) {
  Given_object object(potato(3));
  Displacement_promise promise;
  const Displacement_bound bound = promise.bound(object.bounded());
  Eigen::Isometry3d turned(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitX())), scaled = turned;
  scaled.linear() *= 1.01;
  for (const double distance : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(promise.move(distance), Bad_argument);
    EXPECT_THROW(promise.move(distance, turned), Bad_argument);
  }
  EXPECT_THROW(promise.move(1, scaled), Bad_argument);
  EXPECT_THROW(promise.move(std::vector<double>{1, 2}), Bad_argument);
  EXPECT_EQ(bound.box(0), object.fitted_node(0));
  EXPECT_EQ(promise.total(0), 0);
}

TEST(Displacement_promise, refuses_regions_that_it_does_not_tell_apart) {
  const Face_soup soup(potato(4));
  Given_object object(soup, 6, octants(soup));
  EXPECT_THROW(Displacement_promise(0), Bad_argument);
  const Displacement_promise seven(7), one(1);
  EXPECT_THROW(seven.bound(object.bounded()), Bad_argument);
  EXPECT_EQ(one.bound(object.bounded()).box(0), object.fitted_node(0));
}

}  // namespace
}  // namespace lodestone
