// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/candidate_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace lodestone {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Regions = std::vector<std::pair<Region_index, Region_index>>;

Regions candidates(const Points& a, const Points& b, double distance, Candidate_choice choice = Candidate_choice::all) {
  std::vector<Candidate_pair> pairs{{7, 7, 7}};  // from an earlier call
  candidate_pairs(a, b, distance, choice, pairs);
  Regions regions;
  for (const auto& pair : pairs) {
    EXPECT_EQ(pair.squared_distance, (a[pair.a] - b[pair.b]).squaredNorm());
    regions.emplace_back(pair.a, pair.b);
  }
  return regions;
}

TEST(Candidate_pairs, come_nearest_first) {
  const Points a{{0, 0, 0}, {10, 0, 0}}, b{{3, 0, 0}, {0, 2, 0}, {10, 1, 0}};
  EXPECT_EQ(candidates(a, b, 5), (Regions{{1, 2}, {0, 1}, {0, 0}}));
}

TEST(Candidate_pairs, are_strictly_nearer_than_the_distance) {
  const Points a{{0, 0, 0}}, b{{3, 4, 0}};
  EXPECT_TRUE(candidates(a, b, 5).empty());
  EXPECT_EQ(candidates(a, b, std::nextafter(5.0, 6.0)).size(), 1U);
}

TEST(Candidate_pairs, equally_near_ones_come_by_region_index) {
  const Points a{{0, 0, 0}, {2, 0, 0}}, b{{1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(candidates(a, b, 2), (Regions{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
}

TEST(Candidate_pairs, the_closest_one_is_the_first_of_all) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Points a, b;
    for (int i = 0; i < 8; ++i) {
      a.emplace_back(random() % 4, random() % 4, 0);
      b.emplace_back(random() % 4, random() % 4, 2);
    }
    const auto all = candidates(a, b, 2.5);
    const auto closest = candidates(a, b, 2.5, Candidate_choice::closest);
    if (all.empty()) {
      EXPECT_TRUE(closest.empty());
    } else {
      EXPECT_EQ(closest, Regions{all.front()});
    }
  }
}

TEST(Candidate_pairs, equal_those_of_a_double_loop) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate;
  Points a, b;
  for (int i = 0; i < 60; ++i) {
    a.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    b.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  }
  std::vector<std::tuple<double, Region_index, Region_index>> expected;
  for (Region_index i = 0; i < 60; ++i)
    for (Region_index j = 0; j < 60; ++j)
      if ((a[i] - b[j]).norm() < 0.2) expected.emplace_back((a[i] - b[j]).norm(), i, j);
  std::ranges::sort(expected);
  Regions regions;
  for (const auto& [distance, i, j] : expected) regions.emplace_back(i, j);
  EXPECT_GT(regions.size(), 20U);
  EXPECT_EQ(candidates(a, b, 0.2), regions);
}

TEST(Candidate_pairs, are_the_same_with_several_workers) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate;
  Points a, b;
  for (int i = 0; i < 1300; ++i) a.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  for (int i = 0; i < 150; ++i) b.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  Workers five(5);
  for (const auto choice : {Candidate_choice::all, Candidate_choice::closest})
    for (const bool swapped : {false, true}) {
      const auto &first = swapped ? b : a, &second = swapped ? a : b;
      std::vector<Candidate_pair> alone, shared;
      candidate_pairs(first, second, 0.1, choice, alone);
      candidate_pairs(first, second, 0.1, choice, shared, five);
      EXPECT_GE(alone.size(), choice == Candidate_choice::all ? 100U : 1U);
      ASSERT_EQ(shared.size(), alone.size());
      for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_EQ(shared[i].squared_distance, alone[i].squared_distance);
        EXPECT_EQ(std::pair(shared[i].a, shared[i].b), std::pair(alone[i].a, alone[i].b));
      }
    }
}

TEST(Candidate_pairs, without_particles_are_none) {
  EXPECT_TRUE(candidates({}, {{0, 0, 0}}, 1).empty());
  EXPECT_TRUE(candidates({}, {}, 1, Candidate_choice::closest).empty());
}

}  // namespace
}  // namespace lodestone
