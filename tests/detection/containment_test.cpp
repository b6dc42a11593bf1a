// SPDX-License-Identifier: GPL-3.0-or-later
// Objects inside others, as a detector tells them.
#include <gtest/gtest.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

Detector_options containment(double tolerance = 0, Contact_query query = Contact_query::all) {
  return {.mode = Mode::exact, .contacts = query, .exact = {.tolerance = tolerance, .containment = true}};
}

/// The containment of two meshes, in a frame and asked for, in both orders.
Containment contained(const Surface_mesh& a, const Surface_mesh& b, const Detector_options& options = containment()) {
  Exact_detector detector(options), swapped(options);
  add_all(detector, {&a, &b});
  add_all(swapped, {&b, &a});
  const auto told = [](Exact_detector& asked) {
    const Frame& frame = asked.detect();
    const auto* result = result_of(frame, 0, 1);
    return result == nullptr ? Containment::none : result->containment;
  };
  const auto result = told(detector), opposite = told(swapped);
  EXPECT_EQ(result == Containment::a_in_b, opposite == Containment::b_in_a);
  EXPECT_EQ(result == Containment::b_in_a, opposite == Containment::a_in_b);
  EXPECT_EQ(detector.contains(1, 0), result == Containment::a_in_b);
  EXPECT_EQ(detector.contains(0, 1), result == Containment::b_in_a);
  return result;
}

TEST(Containment, of_a_sphere_in_a_sphere_is_told_with_its_side) {
  for (const double unit : {1.0, 0x1p-300, 0x1p300}) {
    auto outer = sphere(8), inner = sphere(5, 0.3, {0.2, -0.3, 0.4});
    scale(outer, unit), scale(inner, unit);
    EXPECT_EQ(contained(outer, inner), Containment::b_in_a);
    EXPECT_EQ(contained(inner, outer), Containment::a_in_b);
  }
}

TEST(Containment, is_no_collision) {
  const auto outer = sphere(8), inner = sphere(5, 0.3);
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all}) {
    Exact_detector detector(containment(0, query));
    add_all(detector, {&outer, &inner});
    const Frame& frame = detector.detect();
    EXPECT_FALSE(frame.collides());
    ASSERT_EQ(frame.pairs.size(), 1U);
    EXPECT_EQ(frame.pairs[0].containment, Containment::b_in_a);
  }
}

TEST(Containment, does_not_hold_for_objects_beside_each_other) {
  EXPECT_EQ(contained(sphere(5), sphere(5, 1, {1.5, 1.5, 0})), Containment::none);  // boxes overlap
  EXPECT_EQ(contained(sphere(5), sphere(5, 1, {9, 0, 0})), Containment::none);
}

TEST(Containment, does_not_hold_where_surfaces_intersect_or_touch) {
  EXPECT_EQ(contained(sphere(8), sphere(5, 0.5, {0.7, 0, 0})), Containment::none);
  auto inner = cube(4);
  scale(inner, 0.5);
  EXPECT_EQ(contained(cube(4), inner), Containment::none);  // three sides lie in those of the outer one
  shift(inner, 0.125, 0.125);
  EXPECT_EQ(contained(cube(4), inner), Containment::none);  // one side does
  shift(inner, 0, 0, 0.125);
  EXPECT_EQ(contained(cube(4), inner), Containment::b_in_a);
  EXPECT_EQ(contained(sphere(5), sphere(5)), Containment::none);
}

TEST(Containment, does_not_hold_within_a_surface_that_is_open) {
  auto outer = sphere(8);
  const auto inner = sphere(5, 0.3);
  CGAL::Euler::make_hole(outer.halfedge(Surface_mesh::Face_index(7)), outer);
  outer.collect_garbage();
  EXPECT_EQ(contained(outer, inner), Containment::none);
  EXPECT_EQ(contained(inner, outer), Containment::none);
}

TEST(Containment, of_an_open_surface_holds) {
  auto sheet = cloth(6, 6);
  shift(sheet, -0.5, -0.5);
  EXPECT_EQ(contained(sphere(8, 2), sheet), Containment::b_in_a);
}

TEST(Containment, needs_every_piece_to_be_inside) {
  auto pieces = sphere(4, 0.2, {0.5, 0, 0});
  append(pieces, sphere(4, 0.2, {-0.5, 0, 0}));
  EXPECT_EQ(contained(sphere(8), pieces), Containment::b_in_a);
  append(pieces, sphere(4, 0.1, {0.85, 0.85, 0.85}));  // outside, but not of the box
  EXPECT_EQ(contained(sphere(8), pieces), Containment::none);
}

TEST(Containment, in_a_hollow_is_outside) {
  auto shell = sphere(8), cavity = sphere(8, 0.6);
  append(shell, cavity);
  EXPECT_EQ(contained(shell, sphere(4, 0.3)), Containment::none);
  EXPECT_EQ(contained(shell, sphere(4, 0.1, {0.8, 0, 0})), Containment::b_in_a);
}

TEST(Containment, holds_where_the_surfaces_are_nearer_than_the_tolerance_without_meeting) {
  const auto outer = sphere(8), inner = sphere(6, 0.8), far = sphere(6, 0.3), through = sphere(6, 0.8, {0.4, 0, 0});
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all}) {
    const auto options = containment(0.25, query);
    EXPECT_EQ(contained(outer, inner, options), Containment::b_in_a);
    EXPECT_EQ(contained(outer, far, options), Containment::b_in_a);
    EXPECT_EQ(contained(outer, through, options), Containment::none);
    Exact_detector detector(options);
    add_all(detector, {&outer, &inner, &far});
    const Frame& frame = detector.detect();
    EXPECT_TRUE(result_of(frame, 0, 1)->near);
    EXPECT_FALSE(result_of(frame, 0, 1)->collides);
    EXPECT_FALSE(result_of(frame, 0, 2)->near);
  }
}

TEST(Containment, follows_moving_vertices) {
  auto outer = potato(8), inner = sphere(5, 0.2, {-3, 0, 0});
  Exact_detector detector(containment());
  add_all(detector, {&outer, &inner});
  std::size_t inside = 0, meeting = 0;
  for (int frame = 0; frame < 30; ++frame) {
    const Frame& result = detector.detect();
    const auto* pair = result_of(result, 0, 1);
    const double x = -3 + 0.2 * frame;
    const bool meets = !exhaustive_face_pairs(outer, inner).empty();
    // Of a star-shaped outer surface.
    const bool holds = !meets && std::abs(x) < 1.5;
    EXPECT_EQ(pair != nullptr && pair->containment == Containment::b_in_a, holds);
    inside += holds ? 1 : 0;
    meeting += meets ? 1 : 0;
    shift(inner, 0.2);
  }
  EXPECT_GT(inside, 5U);
  EXPECT_GT(meeting, 2U);
}

TEST(Containment, is_told_in_frames_only_if_asked_for) {
  const auto outer = sphere(8), inner = sphere(5, 0.3);
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&outer, &inner});
  for (const auto& pair : detector.detect().pairs) EXPECT_EQ(pair.containment, Containment::none);
  EXPECT_TRUE(detector.contains(0, 1));
}

}  // namespace
}  // namespace lodestone
