// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/find_collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "support/exact_truth.h"

namespace lodestone {
namespace {

TEST(Find_collisions, reports_faces_that_intersect_and_no_others) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-2, 2);
  const auto a = potato(8);
  std::size_t positive = 0, found = 0;
  for (int trial = 0; trial < 20; ++trial) {
    auto b = potato(8, 2);
    shift(b, offset(random), offset(random), offset(random));
    const auto truth = exhaustive_face_pairs(a, b);
    const auto collisions = find_collisions(a, b, {.mode = Mode::particles});
    EXPECT_EQ(collisions.collide, !collisions.faces.empty());
    EXPECT_TRUE(std::ranges::is_sorted(collisions.faces));
    EXPECT_TRUE(std::ranges::includes(truth, collisions.faces));
    EXPECT_EQ(collisions.statistics.contacts, collisions.faces.size());
    EXPECT_TRUE(collisions.points.empty());
    positive += truth.empty() ? 0 : 1;
    found += collisions.collide ? 1 : 0;
  }
  EXPECT_GT(positive, 5U);
  EXPECT_GT(found, 0U);
}

TEST(Find_collisions, misses_nothing_without_options) {
  const auto a = potato(8);
  for (const double x : {-1.9, -1.2, 0.4, 1.1, 1.8}) {
    auto b = potato(8, 2);
    shift(b, x, 0.2, -0.1);
    const auto truth = exhaustive_face_pairs(a, b);
    const auto collisions = find_collisions(a, b);
    EXPECT_EQ(collisions.collide, !truth.empty()) << x;
    EXPECT_EQ(collisions.faces, truth) << x;
  }
}

TEST(Find_collisions, in_mode_exact_gives_all_face_pairs_between_the_two_and_no_others) {
  const auto a = potato(8);
  auto b = potato(8, 2);
  shift(b, 0.7, 0.3, 0);
  const auto truth = exhaustive_face_pairs(a, b);
  ASSERT_FALSE(truth.empty());
  const Detector_options options{
      .mode = Mode::exact, .contact_normals = true, .exact = {.self_collision = true, .containment = true}};
  const auto collisions = find_collisions(a, b, options);
  EXPECT_EQ(collisions.faces, truth);
  EXPECT_EQ(collisions.normals.size(), truth.size());
  EXPECT_EQ(collisions.containment, Containment::none);
  auto capped = options;
  capped.most_contacts = 1;
  EXPECT_TRUE(find_collisions(a, b, capped).capped);
}

TEST(Find_collisions, in_mode_exact_sees_that_one_mesh_lies_inside_the_other) {
  auto small = sphere(6);
  for (const auto v : small.vertices()) small.point(v) = Point(0.1 * small.point(v).x(), 0, 0.1 * small.point(v).z());
  const auto collisions = find_collisions(sphere(6), small, {.mode = Mode::exact, .exact = {.containment = true}});
  EXPECT_FALSE(collisions.collide);
  EXPECT_EQ(collisions.containment, Containment::b_in_a);
}

TEST(Find_collisions, tells_near_from_colliding) {
  const auto a = cube(2);
  auto b = cube(2);
  shift(b, 1.25);
  const auto near = find_collisions(a, b, {.exact = {.tolerance = 0.3}});
  EXPECT_TRUE(near.near);
  EXPECT_FALSE(near.collide);
  EXPECT_EQ(near.faces, near_face_pairs(a, b, 0.3));
  EXPECT_FALSE(find_collisions(a, b).near);
}

TEST(Find_collisions, of_meshes_far_apart_finds_nothing) {
  auto b = sphere(6);
  shift(b, 500);
  const auto collisions = find_collisions(sphere(6), b, {.mode = Mode::particles});
  EXPECT_FALSE(collisions.collide);
  EXPECT_TRUE(collisions.faces.empty());
}

TEST(Find_collisions, with_regions_that_hold_everything_is_exhaustive) {
  auto b = potato(6, 2);
  shift(b, 1.5);
  const auto a = potato(6);
  const auto collisions = find_collisions(a, b,
                                          {.mode = Mode::particles,
                                           .particles = 1,
                                           .meetings = 0,
                                           .collision_distance = 1000,
                                           .contacts = Contact_query::all});
  EXPECT_EQ(collisions.faces, exhaustive_face_pairs(a, b));
  EXPECT_FALSE(collisions.faces.empty());
}

TEST(Find_collisions, gives_points_if_asked) {
  auto b = sphere(8);
  shift(b, 1.5, 0.1);
  const auto collisions = find_collisions(
      sphere(8), b, {.mode = Mode::particles, .particles = 24, .contacts = Contact_query::all, .contact_points = true});
  ASSERT_FALSE(collisions.faces.empty());
  EXPECT_EQ(collisions.points.size(), collisions.faces.size());
}

TEST(Find_collisions, leaves_the_meshes_as_they_are) {
  const auto a = sphere(4), b = sphere(4, 1, {1.5, 0, 0});
  const auto before = a.properties<Surface_mesh::Vertex_index>();
  for (const auto mode : {Mode::exact, Mode::particles}) find_collisions(a, b, {.mode = mode});
  EXPECT_EQ(a.properties<Surface_mesh::Vertex_index>(), before);
}

TEST(Find_collisions, refuses_bad_input) {
  const auto mesh = sphere(3);
  auto broken = sphere(3);
  broken.point(Surface_mesh::Vertex_index(0)) = Point(std::numeric_limits<double>::infinity(), 0, 0);
  for (const auto mode : {Mode::exact, Mode::particles}) {
    EXPECT_THROW(find_collisions(mesh, mesh, {.mode = mode}), Bad_argument);
    EXPECT_THROW(find_collisions(mesh, Surface_mesh(), {.mode = mode}), Bad_mesh);
    EXPECT_THROW(find_collisions(mesh, broken, {.mode = mode}), Bad_mesh);
  }
  EXPECT_THROW(find_collisions(mesh, sphere(2), {.mode = Mode::particles, .collision_distance = -1}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
