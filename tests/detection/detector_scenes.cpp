// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/detector_scenes.h"

namespace lodestone {

std::size_t expect_true(const Frame& frame, const Owned_meshes& scene) {
  std::size_t colliding = 0;
  for (const auto& pair : frame.pairs) {
    EXPECT_LT(pair.a, pair.b);
    const auto truth = exhaustive_face_pairs(scene[pair.a], scene[pair.b]);
    const auto contacts = frame.contacts(pair);
    EXPECT_TRUE(std::ranges::is_sorted(contacts));
    EXPECT_EQ(std::ranges::adjacent_find(contacts), contacts.end());
    EXPECT_TRUE(std::ranges::includes(truth, contacts)) << "frame " << frame.number;
    EXPECT_EQ(pair.collides, !contacts.empty());
    colliding += pair.collides ? 1 : 0;
  }
  return colliding;
}

void expect_sums_of_pairs(const Frame& frame) {
  std::size_t candidates = 0, leaf_tests = 0, next = 0;
  for (const auto& pair : frame.pairs) {
    candidates += pair.candidates;
    leaf_tests += pair.leaf_tests;
    EXPECT_EQ(pair.first_contact, next);
    next += pair.contacts;
  }
  EXPECT_EQ(next, frame.face_pairs.size());
  EXPECT_EQ(frame.statistics.candidates, candidates);
  EXPECT_EQ(frame.statistics.leaf_tests, leaf_tests);
  EXPECT_EQ(frame.statistics.object_candidates, frame.pairs.size());
  EXPECT_EQ(frame.statistics.contacts, frame.face_pairs.size());
  EXPECT_GE(frame.statistics.exact_tests, frame.statistics.contacts);
}

Owned_meshes two_spheres(double distance, int parts) { return {sphere(parts), sphere(parts, 1, {distance, 0.1, 0.2})}; }

void expect_equal(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.face_pairs, b.face_pairs);
  EXPECT_EQ(a.contact_points.size(), b.contact_points.size());
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t i = 0; i < a.pairs.size(); ++i) {
    EXPECT_EQ(a.pairs[i].a, b.pairs[i].a);
    EXPECT_EQ(a.pairs[i].b, b.pairs[i].b);
    EXPECT_EQ(a.pairs[i].collides, b.pairs[i].collides);
    EXPECT_EQ(a.pairs[i].candidates, b.pairs[i].candidates);
  }
  EXPECT_EQ(a.statistics.moves, b.statistics.moves);
  EXPECT_EQ(a.statistics.iterations, b.statistics.iterations);
  EXPECT_EQ(a.statistics.exact_tests, b.statistics.exact_tests);
  EXPECT_EQ(a.statistics.repartitions, b.statistics.repartitions);
}

}  // namespace lodestone
