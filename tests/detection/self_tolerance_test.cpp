// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of one object that are near, as a detector reports them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/volumes/bounding_sphere.h"
#include "support/exact_truth.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

Detector_options within_one(double tolerance) {
  return {.exact = {.self_collision = true, .self_tolerance = tolerance}};
}

/// The right half of the sheet turned over the left one, at a height.
void fold(Surface_mesh& sheet, const Surface_mesh& flat, double height) {
  for (const auto v : flat.vertices()) {
    const Point& p = flat.point(v);
    sheet.point(v) = p.x() < 0.5 ? p : Point(1 - p.x(), p.y(), height * std::min(1.0, 8 * (p.x() - 0.5)));
  }
}

TEST(Self_tolerance_of_a_detector, tells_near_from_colliding) {
  const auto flat = cloth(16, 16);
  auto sheet = flat;
  for (const auto query : {Contact_query::yes_no, Contact_query::all}) {
    auto options = within_one(0.05);
    options.contacts = query;
    place(sheet, positions_of(flat));
    Exact_detector detector(options);
    detector.add(sheet);
    EXPECT_FALSE(detector.detect().near());
    fold(sheet, flat, 0.04);
    EXPECT_TRUE(detector.detect().near());
    EXPECT_FALSE(detector.detect().collides());
    fold(sheet, flat, 0);
    EXPECT_TRUE(detector.detect().near());
    EXPECT_TRUE(detector.detect().collides());
    place(sheet, positions_of(flat));
    EXPECT_FALSE(detector.detect().near());
  }
}

TEST(Self_tolerance_of_a_detector, gives_the_gap_of_faces_that_are_apart) {
  const auto flat = cloth(16, 16);
  auto sheet = flat, plate = cloth(3, 3);  // the plate lies between the layers
  scale(plate, 0.25);
  shift(plate, 0.1, 0.1, 0.01);
  auto options = within_one(0.05);
  options.contact_points = options.contact_normals = options.exact.patches = true;
  Exact_detector detector(options);
  add_all(detector, {&sheet, &plate});
  detector.detect();
  fold(sheet, flat, 0.04);
  const Frame& frame = detector.detect();
  const Pair_result* const self = result_of(frame, 0, 0);
  ASSERT_NE(self, nullptr);
  EXPECT_GT(self->contacts, 50U);
  EXPECT_EQ(self->patches, 1U);
  for (std::size_t i = self->first_contact; i < self->first_contact + self->contacts; ++i) {
    EXPECT_LT(frame.contact_normals[i].depth, 0);
    EXPECT_GT(frame.contact_normals[i].depth, -0.05);
  }
  EXPECT_FALSE(result_of(frame, 0, 1)->near) << "the tolerance within one object does not hold between two";
}

TEST(Self_tolerance_of_a_detector, takes_the_positions_of_the_first_query_as_rest) {
  const auto flat = cloth(16, 16);
  auto sheet = flat;
  Exact_detector detector(within_one(0.05));
  detector.add(sheet);
  fold(sheet, flat, 0.04);
  EXPECT_FALSE(detector.detect().near()) << "near at rest";
  place(sheet, positions_of(flat));
  EXPECT_FALSE(detector.detect().near());
  detector.rebuild(0);
  EXPECT_FALSE(detector.detect().near());
  fold(sheet, flat, 0.04);
  EXPECT_TRUE(detector.detect().near());
}

TEST(Self_tolerance_of_a_detector, keeps_the_rest_when_a_loose_tree_is_rebuilt) {
  const auto flat = cloth(24, 24);
  auto sheet = flat;
  auto options = within_one(0.02);
  options.exact.loosest = 1.01;
  Exact_detector detector(options);
  detector.add(sheet);
  detector.detect();
  crumple(sheet, 0.3, 1);
  EXPECT_GT(detector.detect().statistics.repartitions, 0U);
  fold(sheet, flat, 0.015);
  EXPECT_TRUE(detector.detect().near());
  EXPECT_FALSE(detector.detect().collides());
}

TEST(Self_tolerance_of_a_detector, finds_the_same_with_any_volume_and_number_of_threads) {
  const auto flat = cloth(40, 40);
  auto sheet = flat;
  auto options = within_one(0.02);
  Exact_detector boxes(options);
  options.threads = 2;
  Exact_detector shared(options);
  Volume_detector<Bounding_sphere> spheres(options);
  for (int frame = 0; frame < 3; ++frame) {
    if (frame == 0) boxes.add(sheet), shared.add(std::as_const(sheet)), spheres.add(std::as_const(sheet));
    if (frame == 1) fold(sheet, flat, 0.015);
    if (frame == 2) crumple(sheet, 0.01, 1);
    const Frame& expected = boxes.detect();
    EXPECT_EQ(expected.near(), frame > 0);
    expect_same_frame(shared.detect(), expected);
    EXPECT_EQ(spheres.detect().face_pairs, expected.face_pairs);
  }
}

TEST(Self_tolerance_of_a_detector, out_of_range_or_in_another_mode_is_refused) {
  for (const double bad : {-1.0, infinity, not_a_number})
    EXPECT_THROW(Exact_detector({.exact = {.self_tolerance = bad}}), Bad_argument) << bad;
  EXPECT_THROW(Exact_detector({.mode = Mode::particles, .exact = {.self_tolerance = 0.1}}), Bad_argument);
}

/// Rebuilds two meshes, the second with a coordinate that is not finite.
void rebuild_in_vain(Detector<>& detector, Surface_mesh& second, Surface_mesh::Vertex_index vertex) {
  detector.rebuild(0, Changed_faces{std::vector<std::uint32_t>{0}});
  detector.rebuild(1);
  const Point before = second.point(vertex);
  second.point(vertex) = Point(before.x(), std::numeric_limits<double>::quiet_NaN(), before.z());
  EXPECT_THROW(detector.detect(), Bad_mesh);
  second.point(vertex) = before;
}

TEST(Self_tolerance_of_a_detector, knows_the_positions_at_rest_after_a_frame_that_another_object_has_ended) {
  auto sheet = cloth(16, 16), ball = icosphere(3);
  // Faces of the flat sheet are nearer than this.
  Detector<> detector(within_one(0.2));
  detector.add(sheet), detector.add(ball);
  EXPECT_FALSE(detector.detect().near());
  rebuild_in_vain(detector, ball, ball.add_vertex(Point(0, 0, 0)));
  rebuild_in_vain(detector, ball, *ball.vertices().begin());
  EXPECT_FALSE(detector.detect().near());
}

TEST(Self_tolerance_of_a_detector, saves_finite_positions_at_rest) {
  auto sheet = cloth(16, 16), ball = icosphere(3);
  const auto lone = sheet.add_vertex(Point(0, 0, 0));
  Detector<> detector(within_one(0.2));
  detector.add(sheet), detector.add(ball);
  detector.detect();
  rebuild_in_vain(detector, sheet, lone);
  EXPECT_FALSE(detector.detect().near());
  EXPECT_NO_THROW(detector.load(0, detector.save(0)));
}

}  // namespace
}  // namespace lodestone
