// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of a few meshes, and what every frame of a detector must hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>

#include "lodestone/detector.h"
#include "lodestone/queries/exhaustive.h"
#include "support/test_meshes.h"

namespace lodestone {

using Scene = std::deque<Surface_mesh>;
inline constexpr std::array modes{Mode::particles, Mode::senin};

inline const Detector_options all_contacts{.particles = 32, .contacts = Contact_query::all};

/// Every pair of the frame against exhaustive checking; gives the number of pairs that collide.
inline std::size_t expect_true(const Frame& frame, const Scene& scene) {
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

inline Scene two_spheres(double distance, int parts = 12) {
  return {sphere(parts), sphere(parts, 1, {distance, 0.1, 0.2})};
}

template <class Detector_type>
void add_all(Detector_type& detector, Scene& scene) {
  for (auto& mesh : scene) detector.add(mesh);
}

inline void expect_equal(const Frame& a, const Frame& b) {
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
