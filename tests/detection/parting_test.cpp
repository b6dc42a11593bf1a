// SPDX-License-Identifier: GPL-3.0-or-later
// Translations that part objects, and contact patches, as a detector gives them.
#include <gtest/gtest.h>

#include "lodestone/find_collisions.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// A sphere that collides with a second and holds a third; the fourth is apart.
struct Four_spheres {
  Surface_mesh a = sphere(8), b = sphere(6, 0.8, {1.3, 0.2, 0}), inner = sphere(4, 0.2, {-0.5, 0.3, 0}),
               far = sphere(4, 0.5, {0, 5, 0});
  Meshes meshes{&a, &b, &inner, &far};
};

/// Moves the mesh by the translation; nothing else may be near it afterwards.
void expect_parted(Surface_mesh mesh, const Surface_mesh& other, const Eigen::Vector3d& translation) {
  shift(mesh, translation.x(), translation.y(), translation.z());
  EXPECT_TRUE(exhaustive_face_pairs(mesh, other).empty());
  Exact_detector detector;
  add_all(detector, {&mesh, &other});
  EXPECT_FALSE(detector.contains(0, 1));
  EXPECT_FALSE(detector.contains(1, 0));
  EXPECT_FALSE(detector.parting(0, 1));
}

TEST(Detector_parting, is_given_of_pairs_that_collide_and_of_objects_inside_others_alone) {
  const Four_spheres scene;
  for (const auto query : {Contact_query::yes_no, Contact_query::all}) {
    Exact_detector detector({.contacts = query, .exact = {.self_collision = true, .parting = true}});
    add_all(detector, scene.meshes);
    const Frame frame = detector.detect();
    std::size_t given = 0;
    for (const auto& pair : frame.pairs) {
      EXPECT_EQ(pair.parting.has_value(), pair.collides || pair.containment != Containment::none);
      if (!pair.parting) continue;
      ++given;
      expect_parted(*scene.meshes[pair.a], *scene.meshes[pair.b], pair.parting->translation);
      expect_parted(*scene.meshes[pair.b], *scene.meshes[pair.a], -pair.parting->translation);
      EXPECT_EQ(detector.parting(pair.a, pair.b)->translation, pair.parting->translation);
    }
    EXPECT_EQ(given, 2U);
    EXPECT_EQ(result_of(frame, 0, 2)->containment, Containment::b_in_a);
    EXPECT_FALSE(detector.parting(0, 3));
  }
}

TEST(Detector_parting, is_not_given_unless_asked_for) {
  const Four_spheres scene;
  Exact_detector detector;
  add_all(detector, scene.meshes);
  for (const auto& pair : detector.detect().pairs) EXPECT_FALSE(pair.parting);
}

TEST(Detector_parting, follows_the_positions) {
  auto a = sphere(6);
  const auto b = sphere(6, 1, {1.5, 0, 0});
  Exact_detector detector({.exact = {.tolerance = 0.1, .parting = true}});
  add_all(detector, {&a, &b});
  const double before = detector.detect().pairs[0].parting->length;
  shift(a, 0.25);
  EXPECT_NEAR(detector.parting(0, 1)->length, before + 0.25, 0.02);
  shift(a, -0.8);
  EXPECT_FALSE(detector.parting(0, 1));
  const Frame& near = detector.detect();
  EXPECT_TRUE(near.near());
  EXPECT_FALSE(near.pairs[0].parting) << "near, but apart";
}

TEST(Detector_parting, of_an_object_and_itself_is_refused) {
  const auto a = sphere(4);
  Exact_detector detector;
  detector.add(a);
  EXPECT_THROW(detector.parting(0, 0), Bad_argument);
  EXPECT_THROW(detector.parting(0, 1), Bad_argument);
}

TEST(Detector_patches, group_the_contacts_of_every_pair) {
  auto folded = torus_knot({.tube = 0.5, .segments = 60, .sides = 8});
  const auto left = sphere(8, 1, {-0.8, 0, 0}), right = sphere(8, 1, {0.7, 0.1, 0});
  Exact_detector detector({.exact = {.self_collision = true, .patches = true}});
  add_all(detector, {&folded, &left, &right});
  const Frame& frame = detector.detect();
  std::size_t patches = 0;
  for (const auto& pair : frame.pairs) {
    EXPECT_EQ(pair.first_patch, patches);
    std::vector<bool> seen(pair.contacts);
    for (const auto& patch : frame.patches_of(pair))
      for (const auto contact : patch.contacts) {
        ASSERT_LT(contact, pair.contacts);
        EXPECT_FALSE(seen[contact]);
        seen[contact] = true;
      }
    EXPECT_EQ(std::ranges::count(seen, true), std::ssize(seen));
    patches += pair.patches;
  }
  EXPECT_EQ(frame.patches.size(), patches);
  EXPECT_EQ(frame.contact_points.size(), frame.face_pairs.size());
  EXPECT_EQ(result_of(frame, 1, 2)->patches, 1U);
  EXPECT_GT(result_of(frame, 0, 0)->patches, 1U);
  EXPECT_EQ(result_of(frame, 1, 1)->patches, 0U);
  EXPECT_LT(frame.patches_of(*result_of(frame, 1, 2))[0].normal.x(), -0.99);
}

TEST(Detector_patches, of_near_faces_are_linked_within_the_tolerance) {
  const auto low = cloth(12, 12);
  auto high = cloth(12, 12);
  deform(high, [](const Point& p) { return Point(p.x(), p.y(), 0.2 + 0.15 * std::cos(4 * M_PI * p.x())); });
  Exact_detector detector({.exact = {.tolerance = 0.1, .patches = true}});
  add_all(detector, {&low, &high});
  const Frame& frame = detector.detect();
  ASSERT_EQ(frame.pairs.size(), 1U);
  EXPECT_EQ(frame.pairs[0].patches, 2U);
}

TEST(Find_collisions, gives_a_translation_that_parts_the_two_and_the_contact_patches) {
  const auto a = sphere(6), b = sphere(6, 1, {1.5, 0, 0});
  const auto found = find_collisions(a, b, {.exact = {.parting = true, .patches = true}});
  ASSERT_TRUE(found.parting);
  expect_parted(a, b, found.parting->translation);
  EXPECT_EQ(found.patches.size(), 1U);
  EXPECT_FALSE(find_collisions(a, b).parting);
  EXPECT_TRUE(find_collisions(a, b).patches.empty());
}

}  // namespace
}  // namespace lodestone
