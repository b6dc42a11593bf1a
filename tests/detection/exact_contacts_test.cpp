// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerance, points and normals of the mode exact.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lodestone/triangles/contact_normal.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

TEST(Exact_tolerance, lists_the_faces_that_are_nearer_than_it) {
  for (const double unit : {1.0, 0x1p-300, 0x1p300})
    for (const double tolerance : {1e-3, 0.03, 0.2, 0.7}) {
      auto a = potato(5), b = potato(5, 2);
      scale(a, unit), scale(b, unit);
      Exact_detector detector({.mode = Mode::exact, .exact = {.tolerance = tolerance * unit}});
      add_all(detector, {&a, &b});
      shift(b, 3.9 * unit);
      std::size_t near = 0, apart = 0;
      for (int frame = 0; frame < 4; ++frame) {
        const auto contacts = expect_near_contacts(detector.detect(), 0, 1, a, b, tolerance * unit);
        (contacts == 0 ? apart : near) += 1;
        shift(b, -0.35 * unit);
      }
      EXPECT_GT(near, 0U);
      if (tolerance < 0.1) {
        EXPECT_GT(apart, 0U);
      }
    }
}

TEST(Exact_tolerance, does_not_list_faces_at_just_this_distance) {
  const auto a = cube(2);
  auto b = cube(2);
  shift(b, 1.25);
  for (const double tolerance : {0.25, std::nextafter(0.25, 0), std::nextafter(0.25, 1)}) {
    Exact_detector detector({.mode = Mode::exact, .exact = {.tolerance = tolerance}});
    add_all(detector, {&a, &b});
    const Frame& frame = detector.detect();
    EXPECT_EQ(frame.near(), tolerance > 0.25);
    EXPECT_FALSE(frame.collides());
    expect_near_contacts(frame, 0, 1, a, b, tolerance);
  }
}

/// As many exact tests as there are faces near each, not as there are within the tolerance along every axis.
TEST(Exact_tolerance, that_is_the_gap_of_wide_plates_leaves_few_pairs_to_exact_tests) {
  for (const bool turned : {false, true}) {
    auto low = cloth(20, 20), high = cloth(20, 20);
    shift(high, 0, 0, 0.5);
    if (turned)
      for (auto* plate : {&low, &high})
        deform(*plate, [](const Point& p) {
          return Point(0.8 * p.x() - 0.36 * p.y() + 0.48 * p.z(), 0.6 * p.x() + 0.48 * p.y() - 0.64 * p.z(),
                       0.8 * p.y() + 0.6 * p.z());
        });
    for (const double tolerance : {0.5, 0.5 * (1 - 1e-9), 0.5 * (1 + 1e-9)}) {
      Exact_detector detector({.mode = Mode::exact, .exact = {.tolerance = tolerance}});
      add_all(detector, {&low, &high});
      const Frame& frame = detector.detect();
      expect_near_contacts(frame, 0, 1, low, high, tolerance);
      EXPECT_LT(frame.statistics.exact_tests, 40 * low.number_of_faces()) << turned << ", " << tolerance;
    }
  }
}

TEST(Exact_tolerance, reaches_across_many_objects) {
  std::deque<Surface_mesh> owned;
  for (int i = 0; i < 12; ++i) owned.push_back(sphere(3, 1, {2.1 * (i % 4), 2.2 * (i / 4), 0.1 * i}));
  const auto meshes = all_of(owned);
  Exact_detector detector({.mode = Mode::exact, .exact = {.tolerance = 0.3}});
  add_all(detector, meshes);
  const Frame& frame = detector.detect();
  std::size_t near = 0;
  for (Object_id a = 0; a < 12; ++a)
    for (Object_id b = a + 1; b < 12; ++b) {
      near += expect_near_contacts(frame, a, b, *meshes[a], *meshes[b], 0.3) > 0 ? 1 : 0;
    }
  EXPECT_GT(near, 8U);
  EXPECT_LT(near, 12U * 11 / 2);
}

TEST(Exact_tolerance, near_objects_are_told_from_colliding_ones_by_every_query) {
  const auto still = sphere(6), touching = sphere(6, 1, {1.9, 0, 0}), beside = sphere(6, 1, {0, 2.2, 0}),
             far = sphere(6, 1, {0, 0, 9});
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all})
    for (const std::size_t most : {std::size_t{1}, std::numeric_limits<std::size_t>::max()}) {
      Exact_detector detector(
          {.mode = Mode::exact, .contacts = query, .most_contacts = most, .exact = {.tolerance = 0.3}});
      add_all(detector, {&still, &touching, &beside, &far});
      const Frame& frame = detector.detect();
      EXPECT_TRUE(frame.near() && frame.collides());
      EXPECT_TRUE(result_of(frame, 0, 1)->collides);
      EXPECT_TRUE(result_of(frame, 0, 1)->near);
      EXPECT_FALSE(result_of(frame, 0, 2)->collides);
      EXPECT_TRUE(result_of(frame, 0, 2)->near);
      for (const auto& pair : frame.pairs) EXPECT_NE(pair.b, 3U);
      EXPECT_FALSE(detector.detect(0, 2).collides());
      EXPECT_TRUE(detector.detect(0, 2).near());
    }
}

TEST(Exact_tolerance, of_zero_makes_nothing_near) {
  const auto a = sphere(6), b = sphere(6, 1, {1.9, 0, 0});
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  EXPECT_TRUE(detector.detect().collides());
  EXPECT_FALSE(detector.detect().near());
}

double distance(const Point& p, const Triangle& t) {
  return std::sqrt(CGAL::squared_distance(p, Kernel::Triangle_3(t[0], t[1], t[2])));
}

/// Points and normals of every listed pair of two meshes of extent 1; gives how many pairs are near without meeting.
std::size_t expect_geometry(const Frame& frame, const Surface_mesh& mesh_a, const Surface_mesh& mesh_b) {
  EXPECT_EQ(frame.contact_points.size(), frame.face_pairs.size());
  EXPECT_EQ(frame.contact_normals.size(), frame.face_pairs.size());
  std::size_t apart = 0;
  for (std::size_t i = 0; i < frame.face_pairs.size(); ++i) {
    const auto a = triangle_of(mesh_a, frame.face_pairs[i].a), b = triangle_of(mesh_b, frame.face_pairs[i].b);
    const auto& points = frame.contact_points[i];
    EXPECT_FALSE(points.empty());
    for (const auto& p : points) EXPECT_TRUE(coordinates(p).allFinite());
    if (triangles_intersect(a, b)) {
      for (const auto& p : points) {
        EXPECT_LT(distance(p, a), 1e-14);
        EXPECT_LT(distance(p, b), 1e-14);
      }
    } else {
      ++apart;
      EXPECT_EQ(points.size(), 2U);
      EXPECT_LT(distance(points[0], a), 1e-14);
      EXPECT_LT(distance(points[1], b), 1e-14);
      EXPECT_NEAR((coordinates(points[0]) - coordinates(points[1])).norm(), closest_points(a, b).distance, 1e-14);
    }
    const auto& [normal, depth] = frame.contact_normals[i];
    EXPECT_NEAR(normal.norm(), 1, 1e-14);
    if (triangles_intersect(a, b)) {
      const auto expected = contact_normal(a, b);
      EXPECT_GE(depth, 0);
      EXPECT_LT((normal - expected.normal).norm(), 1e-14);  // the triangle of a face may start at another corner
      EXPECT_NEAR(depth, expected.depth, 1e-14);
    } else {
      // Moved against the normal by as much as they are apart, a touches b where both are nearest.
      EXPECT_NEAR(-depth, closest_points(a, b).distance, 1e-14);
      EXPECT_LT((coordinates(points[0]) + depth * normal - coordinates(points[1])).norm(), 1e-13);
    }
  }
  return apart;
}

TEST(Exact_contacts, points_lie_on_both_faces_and_normals_have_length_one) {
  auto a = potato(12), b = potato(12, 2);
  Exact_detector detector({.mode = Mode::exact, .contact_points = true, .contact_normals = true});
  add_all(detector, {&a, &b});
  for (int frame = 0; frame < 5; ++frame) {
    shift(b, 0.5, 0.03, -0.07);
    const Frame& result = detector.detect();
    EXPECT_GT(result.face_pairs.size(), 20U);
    EXPECT_EQ(expect_geometry(result, a, b), 0U);
  }
}

TEST(Exact_contacts, of_faces_that_are_near_are_their_nearest_points) {
  auto a = potato(8), b = potato(8, 2);
  Exact_detector detector(
      {.mode = Mode::exact, .contact_points = true, .contact_normals = true, .exact = {.tolerance = 0.1}});
  add_all(detector, {&a, &b});
  std::size_t apart = 0;
  for (int frame = 0; frame < 5; ++frame) {
    shift(b, 0.66, 0.03, -0.07);
    apart += expect_geometry(detector.detect(), a, b);
  }
  EXPECT_GT(apart, 100U);
}

TEST(Exact_contacts, normals_point_from_the_second_object_to_the_first) {
  const auto a = sphere(10), b = sphere(10, 1, {1.9, 0, 0});
  Exact_detector detector({.mode = Mode::exact, .contacts = Contact_query::first, .contact_normals = true});
  add_all(detector, {&a, &b});
  const Frame& frame = detector.detect();
  ASSERT_EQ(frame.contact_normals.size(), 1U);
  EXPECT_TRUE(frame.contact_points.empty());
  EXPECT_LT(frame.contact_normals[0].normal.x(), -0.9);
  EXPECT_LT(frame.contact_normals[0].depth, 0.3);
}

TEST(Exact_contacts, geometry_is_parallel_to_the_face_pairs_of_several_objects_and_of_one_with_itself) {
  auto a = sphere(8), b = sphere(8, 1, {1.5, 0, 0}), c = sphere(8, 1, {-1.5, 0.1, 0});
  crumple(b, 0.15, 1);
  Exact_detector detector({.mode = Mode::exact,
                           .contact_points = true,
                           .contact_normals = true,
                           .most_contacts = 40,
                           .exact = {.self_collision = true}});
  const Meshes meshes{&a, &b, &c};
  add_all(detector, meshes);
  const Frame& frame = detector.detect();
  ASSERT_NE(result_of(frame, 1, 1), nullptr);
  EXPECT_TRUE(result_of(frame, 1, 1)->collides);
  ASSERT_EQ(frame.contact_points.size(), frame.face_pairs.size());
  ASSERT_EQ(frame.contact_normals.size(), frame.face_pairs.size());
  for (const auto& pair : frame.pairs)
    for (std::size_t i = pair.first_contact; i < pair.first_contact + pair.contacts; ++i)
      for (const auto& p : frame.contact_points[i]) {
        EXPECT_LT(distance(p, triangle_of(*meshes[pair.a], frame.face_pairs[i].a)), 1e-14);
        EXPECT_LT(distance(p, triangle_of(*meshes[pair.b], frame.face_pairs[i].b)), 1e-14);
      }
}

}  // namespace
}  // namespace lodestone
