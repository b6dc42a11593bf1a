// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/closest_faces.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/arm.h"
#include "support/face_soup.h"

namespace lodestone {
namespace {

/// The closest of all face pairs.
Closest_faces by_all_pairs(const Face_soup& a, const Face_soup& b) {
  Closest_faces best;
  bool any = false;
  for (std::uint32_t i = 0; i < a.faces.size(); ++i)
    for (std::uint32_t j = 0; j < b.faces.size(); ++j) {
      const auto points = closest_points(a.triangle(i), b.triangle(j));
      if (!any || points.distance < best.points.distance) best = {{i, j}, points};
      any = true;
    }
  return best;
}

/// Checks two objects in both orders and with several leaf sizes, and returns their distance.
double expect_closest(const Face_soup& first, const Face_soup& second) {
  const auto check = [](const Face_soup& s, const Face_soup& t) {
    const auto truth = by_all_pairs(s, t);
    for (const std::size_t leaf_faces : {2, 10, 128}) {
      const Posed_object a(s, leaf_faces), b(t, 8, false);
      for (int time = 0; time < 2; ++time) {
        const auto found = closest_faces(a.view(), b.view());
        EXPECT_EQ(found.points.distance, truth.points.distance);
        EXPECT_EQ(found.faces, truth.faces);
        EXPECT_EQ(found.points.a, truth.points.a);
        EXPECT_EQ(found.points.b, truth.points.b);
      }
    }
    EXPECT_EQ(truth.points.distance == 0, !true_pairs(s, t).empty());
    return truth.points.distance;
  };
  check(second, first);
  return check(first, second);
}

/// Objects of a few dozen faces.
std::vector<Face_soup> few_faces() {
  return {icosphere(2),
          Face_soup(potato(3)),
          teapot({1, 1}),
          cloth(6, 5),
          loose_triangles(40, 0.4, 1),
          lattice_soup(30, 30, 4, 1),
          Face_soup(single_triangle())};
}

TEST(Closest_faces, equal_those_of_all_pairs_in_any_pose) {
  std::mt19937_64 random(1);
  int apart = 0, meeting = 0;
  const auto objects = few_faces();
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (std::size_t j = i; j < objects.size(); ++j)
      for (const double distance : {0.5, 2.0, 5.0}) {
        SCOPED_TRACE(testing::Message() << i << ' ' << j << ' ' << distance);
        const auto pose = posed_at_random(objects[j], distance, random);
        ++(expect_closest(objects[i], pose) > 0 ? apart : meeting);
      }
  EXPECT_GT(apart, 20);
  EXPECT_GT(meeting, 20);
}

TEST(Closest_faces, of_many_at_the_same_distance_are_the_lowest) {
  const Face_soup box(cube(2)), sheet(cloth(4, 4));
  EXPECT_EQ(expect_closest(box, moved(box, 3, 0, 0)), 2);
  EXPECT_EQ(expect_closest(box, moved(box, 4, 5, 0)), 5);
  EXPECT_EQ(expect_closest(sheet, moved(sheet, 0, 0, 0.25)), 0.25);
  EXPECT_EQ(expect_closest(shuffled(sheet, 1), moved(shuffled(sheet, 2), 0, 0, 0.25)), 0.25);
  // The least distances, at which bounds are not rounded down.
  EXPECT_EQ(expect_closest(shuffled(sheet, 1), moved(shuffled(sheet, 2), 0, 0, 0x1p-1073)), 0x1p-1073);
}

TEST(Closest_faces, of_shapes_that_touch_or_coincide_are_at_distance_zero) {
  const Face_soup box(cube(2)), sheet(cloth(4, 4)), ball(icosphere(2));
  EXPECT_EQ(expect_closest(box, moved(box, 1, 0, 0)), 0);
  EXPECT_EQ(expect_closest(box, moved(box, 1, 1, 1)), 0);
  EXPECT_EQ(expect_closest(box, moved(sheet, 0.25, 0.25, 1)), 0);
  EXPECT_EQ(expect_closest(ball, ball), 0);
}

TEST(Closest_faces, of_nested_shapes_are_found) {
  const Face_soup ball(icosphere(2));
  EXPECT_GT(expect_closest(ball, placed(ball, 0.5)), 0.3);
  EXPECT_GT(expect_closest(ball, placed(ball, 0x1p-20)), 0.7);
  EXPECT_GT(expect_closest(placed(cube(2), 8, -4), moved(cube(2), -0.5, -0.5, -0.5)), 3.4);
}

TEST(Closest_faces, of_shapes_far_apart_or_far_from_the_origin_are_found) {
  std::mt19937_64 random(2);
  for (const auto& object : few_faces()) {
    const auto pose = posed_at_random(object, 1, random);
    EXPECT_GT(expect_closest(icosphere(2), moved(pose, 0x1p40, 3, 0)), 0x1p39);
    EXPECT_GT(expect_closest(icosphere(2), moved(pose, 1e200, -1e200, 1e100)), 1e199);
    expect_closest(placed(icosphere(2), 1, 0x1p20), placed(moved(pose, 2, 2, 0), 1, 0x1p20));
  }
}

TEST(Closest_faces, that_share_a_corner_are_found_where_products_of_their_coordinates_overflow) {
  const Point shared(0, -3, -4);
  for (const double scale : {1.0, 1e153, 1e155, 1e200, 4e307}) {
    const auto triangle = [&](const Point& p, const Point& q) {
      Face_soup soup;
      for (const Point& corner : {shared, p, q})
        for (int axis = 0; axis < 3; ++axis) soup.coordinates.push_back(scale / 4 * corner[axis]);
      soup.faces = {{0, 1, 2}};
      return soup;
    };
    EXPECT_EQ(expect_closest(triangle({1, 4, 1}, {2, 2, -3}), triangle({-3, 0, 3}, {2, 1, 2})), 0) << scale;
  }
}

TEST(Closest_faces, scale_with_powers_of_two) {
  std::mt19937_64 random(3);
  for (const auto& object : few_faces()) {
    const auto pose = posed_at_random(object, 3, random);
    const double distance = expect_closest(icosphere(2), pose);
    for (const double factor : {0x1p-600, 0x1p-300, 0x1p300, 0x1p900})
      EXPECT_EQ(expect_closest(placed(icosphere(2), factor), placed(pose, factor)), factor * distance);
  }
}

TEST(Closest_faces, at_a_distance_that_overflows_are_the_lowest) {
  const Face_soup ball(icosphere(1));
  EXPECT_EQ(expect_closest(placed(ball, 1e300, -1.7e308), placed(ball, 1e300, 1.7e308)),
            std::numeric_limits<double>::infinity());
}

TEST(Closest_faces, of_larger_meshes_equal_those_of_all_pairs) {
  std::mt19937_64 random(4);
  const Face_soup knot(torus_knot({.radius = 0.7, .tube = 0.1, .segments = 40, .sides = 7})), ball(icosphere(5));
  EXPECT_GT(expect_closest(knot, moved(ball, 2.5, 0.3, 0.2)), 0);
  EXPECT_GT(expect_closest(knot, placed(ball, 4)), 0);
}

/// The closest faces of two surfaces that are bounded must be those of their trees, fitted to all positions.
Closest_faces expect_as_fitted(Bounded_surface& a, Bounded_surface& b, const Arm& arm_a, const Arm& arm_b) {
  const Posed_object fitted_a(Face_soup(arm_a.mesh)), fitted_b(Face_soup(arm_b.mesh));
  const auto truth = closest_faces(fitted_a.view(), fitted_b.view()), found = closest_faces(a, b);
  EXPECT_EQ(found.faces, truth.faces);
  EXPECT_EQ(found.points.distance, truth.points.distance);
  EXPECT_EQ(found.points.a, truth.points.a);
  EXPECT_EQ(found.points.b, truth.points.b);
  return found;
}

TEST(Closest_faces, of_bounded_surfaces_equal_those_of_fitted_ones) {
  std::mt19937_64 random(5);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  int meeting = 0, rounds = 0;
  for (const bool morphed : {false, true})
    for (const std::size_t leaf_faces : {4, 40}) {
      Arm a(long_potato(7, 1), morphed, leaf_faces), b(long_potato(6, 2), !morphed, leaf_faces);
      for (int round = 0; round < 12; ++round, ++rounds) {
        a.pose(1.5 * number(), {0, 0, 0});
        b.pose(1.5 * number(), {5 * number(), 3 * number(), 3 * number()});
        meeting += expect_as_fitted(a.surface, b.surface, a, b).points.distance == 0 ? 1 : 0;
        expect_as_fitted(b.surface, a.surface, b, a);
        EXPECT_FALSE(a.surface.is_broken() || b.surface.is_broken());
      }
    }
  EXPECT_GT(meeting, 3);
  EXPECT_LT(meeting, rounds - 3);
}

TEST(Closest_faces, of_bounded_surfaces_are_found_with_few_leaves_posed) {
  Surface_mesh smooth = sphere(40);
  for (const auto v : smooth.vertices())
    smooth.point(v) = Point(3 * smooth.point(v).x(), smooth.point(v).y(), smooth.point(v).z());
  Arm a(smooth, false), b(smooth, false);
  a.pose(0.2, {0, 0, 0});
  b.pose(-0.2, {7, 0.3, 0});
  expect_as_fitted(a.surface, b.surface, a, b);
  EXPECT_FALSE(a.surface.all_posed());
  EXPECT_GT(a.surface.leaves_posed(), 0U);
  EXPECT_LT(a.surface.leaves_posed(), a.layout.leaf_count() / 8);
}

TEST(Closest_faces, of_one_posed_and_one_bounded_surface_equal_those_of_fitted_ones) {
  Arm a(long_potato(8, 1), false), b(long_potato(8, 2), false);
  for (const double x : {0.5, 3.0, 9.0}) {
    a.pose(0.4, {0, 0, 0});
    b.pose(-0.4, {x, 1, 0});
    a.surface.start_frame();
    a.surface.pose_all();
    expect_as_fitted(a.surface, b.surface, a, b);
    expect_as_fitted(b.surface, a.surface, b, a);
  }
}

TEST(Closest_faces, are_right_where_a_broken_bound_is_noticed) {
  Arm a(long_potato(10, 1), false), b(long_potato(10, 2), false);
  a.pose(0.4, {0, 0, 0});
  b.pose(0.8, {1.5, 2.5, 0});
  int broken = 0;
  for (std::uint32_t from = 0; from < a.bound.node_count(); from += 3) {
    const Shrunk_bound lie{a.bound, from};
    Tree_surface tree = a.tree;
    Bounded_surface surface(tree, a.points, lie);
    closest_faces(surface, b.surface);
    if (surface.violations() == 0) continue;
    ++broken;
    EXPECT_FALSE(surface.is_broken());
    expect_as_fitted(surface, b.surface, a, b);
  }
  EXPECT_GT(broken, 10);
}

TEST(Closest_faces, of_surfaces_with_infinite_bounds_equal_those_of_fitted_ones) {
  Arm a(long_potato(6, 1), false), b(long_potato(6, 2), false);
  const No_bound nothing{a.bound.node_count()};
  a.pose(0.4, {0, 0, 0});
  for (const double x : {0.5, 5.0}) {
    b.pose(0.8, {x, 0.5, 0});
    Bounded_surface surface(a.tree, a.points, nothing);
    expect_as_fitted(surface, b.surface, a, b);
  }
}

}  // namespace
}  // namespace lodestone
