// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts within a tolerance: which of them intersect, and which come first where not all are listed.
#include <gtest/gtest.h>

#include <algorithm>

#include "lodestone/find_collisions.h"
#include "lodestone/queries/pair_contacts.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// Two spheres of which some faces intersect, and many more are near.
struct Spheres {
  Surface_mesh a = sphere(6), b = sphere(6, 1, {1.9, 0.02, 0.01});
  std::vector<Face_pair> intersecting = exhaustive_face_pairs(a, b);
};

Detector_options with_tolerance(Mode mode, Contact_query query) {
  return {.mode = mode, .contacts = query, .exact = {.tolerance = 0.2}};
}

TEST(Near_contacts, without_a_tolerance_all_intersect) {
  const Spheres spheres;
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&spheres.a, &spheres.b});
  const Frame& frame = detector.detect();
  EXPECT_TRUE(frame.contact_intersects.empty());
  EXPECT_EQ(intersecting_contacts(frame, frame.pairs.at(0)), spheres.intersecting);
}

TEST(Near_contacts, that_intersect_are_those_of_exhaustive_checking) {
  const Spheres spheres;
  ASSERT_FALSE(spheres.intersecting.empty());
  for (const Mode mode : {Mode::exact, Mode::certified}) {
    Detector<> detector(with_tolerance(mode, Contact_query::all));
    add_all(detector, {&spheres.a, &spheres.b});
    const Frame& frame = detector.detect();
    EXPECT_GT(frame.face_pairs.size(), 2 * spheres.intersecting.size());
    EXPECT_EQ(intersecting_contacts(frame, frame.pairs.at(0)), spheres.intersecting);
  }
  const auto found = find_collisions(spheres.a, spheres.b, with_tolerance(Mode::exact, Contact_query::all));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(found.intersects, 1)), spheres.intersecting.size());
}

TEST(Near_contacts, of_the_last_frame_are_gone_in_the_next) {
  Spheres spheres;
  for (const Mode mode : {Mode::exact, Mode::certified}) {
    Detector<> detector(with_tolerance(mode, Contact_query::all));
    add_all(detector, {&spheres.a, &spheres.b});
    EXPECT_FALSE(detector.detect().contact_intersects.empty());
    shift(spheres.b, 9);
    EXPECT_TRUE(detector.detect().contact_intersects.empty());
    shift(spheres.b, -9);
  }
}

TEST(Near_contacts, the_first_intersects_if_any_does) {
  Spheres spheres;
  for (const Mode mode : {Mode::exact, Mode::certified}) {
    Detector<> detector(with_tolerance(mode, Contact_query::first));
    add_all(detector, {&spheres.a, &spheres.b});
    const Frame& frame = detector.detect();
    ASSERT_EQ(frame.face_pairs.size(), 1U);
    EXPECT_TRUE(std::ranges::binary_search(spheres.intersecting, frame.face_pairs[0]));
    EXPECT_TRUE(frame.intersects(0));
  }
  shift(spheres.b, 0.15);
  Exact_detector apart(with_tolerance(Mode::exact, Contact_query::first));
  add_all(apart, {&spheres.a, &spheres.b});
  const Frame& frame = apart.detect();
  ASSERT_EQ(frame.face_pairs.size(), 1U);
  EXPECT_FALSE(frame.collides());
  EXPECT_FALSE(frame.intersects(0));
}

TEST(Near_contacts, that_intersect_are_not_cut_off_before_those_that_are_only_near) {
  const Spheres spheres;
  const std::size_t count = spheres.intersecting.size();
  for (const std::size_t most : {std::size_t{1}, count - 1, count, count + 1, count + 7}) {
    auto options = with_tolerance(Mode::exact, Contact_query::all);
    options.most_contacts = most;
    Exact_detector detector(options);
    add_all(detector, {&spheres.a, &spheres.b});
    const Frame& frame = detector.detect();
    EXPECT_EQ(frame.face_pairs.size(), most);
    EXPECT_TRUE(frame.capped());
    EXPECT_TRUE(std::ranges::is_sorted(frame.face_pairs));
    EXPECT_EQ(intersecting_contacts(frame, frame.pairs.at(0)).size(), std::min(most, count));
  }
}

TEST(Near_contacts, of_one_object_tell_it_too) {
  const auto flat = cloth(12, 12);
  auto sheet = flat;
  Exact_detector detector({.exact = {.self_collision = true, .self_tolerance = 0.05}});
  detector.add(sheet);
  detector.detect();
  for (const auto v : flat.vertices()) {  // one half turned over the other, and through it at an end
    const Point& p = flat.point(v);
    if (p.x() > 0.5) sheet.point(v) = Point(1 - p.x(), p.y(), 0.04 - 0.06 * p.y());
  }
  const Frame& frame = detector.detect();
  const Pair_result& pair = frame.pairs.at(0);
  Exact_detector without({.exact = {.self_collision = true}});
  without.add(sheet);
  const auto truth = without.detect().face_pairs;
  EXPECT_FALSE(truth.empty());
  EXPECT_EQ(intersecting_contacts(frame, pair), truth);
  EXPECT_GT(pair.contacts, truth.size());
}

TEST(Near_contacts, give_points_and_normals_of_what_they_are) {
  const Spheres spheres;
  auto options = with_tolerance(Mode::exact, Contact_query::all);
  options.contact_points = options.contact_normals = true;
  Exact_detector detector(options);
  add_all(detector, {&spheres.a, &spheres.b});
  const Frame& frame = detector.detect();
  for (std::size_t i = 0; i < frame.face_pairs.size(); ++i)
    EXPECT_EQ(frame.intersects(i), frame.contact_normals[i].depth >= 0) << i;
}

TEST(Preferred_contacts, take_the_places_of_others) {
  const std::vector<Face_pair> preferred{{1, 1}, {2, 5}, {4, 0}};
  std::vector<Face_pair> found{{9, 9}, {0, 7}, {2, 5}, {3, 3}, {8, 8}};  // the first is of another pair
  prefer(preferred, found, 1);
  EXPECT_EQ(found, (std::vector<Face_pair>{{9, 9}, {0, 7}, {1, 1}, {2, 5}, {4, 0}}));
  prefer({}, found, 0);
  EXPECT_EQ(found.size(), 5U);
}

}  // namespace
}  // namespace lodestone
