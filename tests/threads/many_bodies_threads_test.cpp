// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of small objects are searched side by side, and contacts share the work on their points: neither shows.
#include <gtest/gtest.h>

#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// Small bodies in a grid, each of which meets its neighbours, and a large one through all of them.
std::deque<Surface_mesh> bodies() {
  std::deque<Surface_mesh> owned;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 3; ++z) owned.push_back(sphere(5, 0.55, {1.0 * x, 1.0 * y, 1.0 * z}));
  owned.push_back(sphere(36, 2.4, {1.5, 1.5, 1}));
  return owned;
}

std::vector<Frame> frames(std::deque<Surface_mesh> owned, Detector_options options, std::size_t threads) {
  options.threads = threads;
  // So small that the large body is not searched as one of the small ones.
  options.tree.leaf_faces = 8;
  Exact_detector detector(options);
  add_all(detector, all_of(owned));
  std::vector<Frame> result;
  for (int frame = 0; frame < 3; ++frame) {
    result.push_back(detector.detect());
    crumple(owned[5], 0.2, 1);
    shift(owned[7], 0.2, 0.1);
  }
  result.push_back(detector.detect(5, 6));
  return result;
}

void expect_the_same(const std::deque<Surface_mesh>& owned, const Detector_options& options) {
  const auto expected = frames(owned, options, 1);
  EXPECT_TRUE(expected.front().collides());
  EXPECT_GT(expected.front().statistics.leaf_tests, 300U);  // far more than one thread looks at before it wakes others
  for (const std::size_t threads : {2, 5}) {
    const auto found = frames(owned, options, threads);
    for (std::size_t i = 0; i < expected.size(); ++i) expect_same_frame(found[i], expected[i]);
  }
}

TEST(Many_bodies_threads, all_contacts_are_those_of_exhaustive_checking) {
  const auto owned = bodies();
  Exact_detector detector({.exact = {.self_collision = true}, .threads = 2});
  add_all(detector, all_of(owned));
  const Frame& frame = detector.detect();
  std::size_t pairs = 0;
  for (Object_id a = 0; a < 20; ++a)
    for (Object_id b = a + 1; b < 20; ++b) {
      const auto truth = exhaustive_face_pairs(owned[a], owned[b]);
      pairs += truth.empty() ? 0 : 1;
      expect_contacts(frame, a, b, truth);
    }
  EXPECT_GT(pairs, 20U);
}

TEST(Many_bodies_threads, each_query_does_not_depend_on_their_number) {
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all})
    expect_the_same(bodies(), {.contacts = query});
}

TEST(Many_bodies_threads, capped_contacts_do_not_depend_on_their_number) {
  expect_the_same(bodies(), {.most_contacts = 3});
}

TEST(Many_bodies_threads, near_faces_do_not_depend_on_their_number) {
  expect_the_same(bodies(), {.exact = {.tolerance = 0.02}});
}

TEST(Many_bodies_threads, self_collisions_do_not_depend_on_their_number) {
  expect_the_same(bodies(), {.exact = {.self_collision = true, .self_tolerance = 0.01}});
}

TEST(Many_bodies_threads, containment_does_not_depend_on_their_number) {
  auto owned = bodies();
  owned.back() = sphere(36, 5, {1.5, 1.5, 1});
  expect_the_same(owned, {.contacts = Contact_query::yes_no, .exact = {.containment = true}});
}

/// So many contacts of one pair that several threads compute their points.
TEST(Many_bodies_threads, first_impacts_do_not_depend_on_their_number) {
  std::deque<Surface_mesh> owned;
  std::vector<Positions> ends;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) {
      owned.push_back(sphere(4, 0.3, {1.0 * x, 1.0 * y, 0.1 * x * y}));
      const Positions now = Numbered_mesh(owned.back()).positions;
      const Eigen::RowVector3d centre = now.colwise().mean();
      ends.push_back((2.0 + 0.1 * x) * (now.rowwise() - centre));
      ends.back().rowwise() += centre;
    }
  const auto impacts = [&](std::size_t threads) {
    Exact_detector detector({.exact = {.self_collision = true}, .threads = threads});
    add_all(detector, all_of(owned));
    return detector.first_impacts(ends);
  };
  const auto expected = impacts(1);
  EXPECT_GT(expected.size(), 10U);
  for (const std::size_t threads : {2, 5}) {
    const auto found = impacts(threads);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].objects, expected[i].objects);
      EXPECT_EQ(found[i].impact.faces, expected[i].impact.faces);
      EXPECT_EQ(found[i].impact.exact_time, expected[i].impact.exact_time);
      EXPECT_EQ(found[i].impact.point, expected[i].impact.point);
    }
  }
}

TEST(Many_bodies_threads, points_and_normals_of_many_contacts_do_not_depend_on_their_number) {
  const std::deque<Surface_mesh> owned{sphere(45), sphere(44, 1, {0.31, 0.13, 0.07})};
  for (const double tolerance : {0.0, 0.002}) {
    std::vector<Frame> found;
    for (const std::size_t threads : {1, 2, 5}) {
      Exact_detector detector(
          {.contact_points = true, .contact_normals = true, .exact = {.tolerance = tolerance}, .threads = threads});
      add_all(detector, all_of(owned));
      found.push_back(detector.detect());
      EXPECT_GT(found.back().face_pairs.size(), 600U);
      expect_same_frame(found.back(), found.front());
    }
  }
}

}  // namespace
}  // namespace lodestone
