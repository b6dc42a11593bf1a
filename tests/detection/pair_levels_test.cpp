// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/pair_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace lodestone {
namespace {

std::vector<std::vector<std::uint32_t>> levels_of(Pair_levels& levels, const std::vector<Object_pair>& pairs) {
  levels.assign(pairs);
  std::vector<std::vector<std::uint32_t>> result;
  for (std::size_t i = 0; i < levels.size(); ++i) result.emplace_back(levels.level(i).begin(), levels.level(i).end());
  return result;
}

TEST(Pair_levels, keep_pairs_with_an_object_in_common_in_order) {
  using Levels = std::vector<std::vector<std::uint32_t>>;
  Pair_levels levels;
  EXPECT_EQ(levels_of(levels, {}), Levels());
  EXPECT_EQ(levels_of(levels, {{0, 1}, {0, 2}, {1, 2}, {3, 9}}), (Levels{{0, 3}, {1}, {2}}));
  EXPECT_EQ(levels_of(levels, {{4, 5}}), (Levels{{0}}));
  EXPECT_EQ(levels_of(levels, {{0, 9}, {1, 9}, {2, 9}}), (Levels{{0}, {1}, {2}}));
  EXPECT_EQ(levels_of(levels, {}), Levels());
}

TEST(Pair_levels, of_random_pairs_hold_each_once_and_none_could_be_earlier) {
  std::mt19937 random(1);
  Pair_levels levels;
  for (std::uint32_t objects : {2U, 5U, 40U}) {
    std::vector<Object_pair> pairs;
    for (std::uint32_t a = 0; a < objects; ++a)
      for (std::uint32_t b = a + 1; b < objects; ++b)
        if (random() % 3 > 0) pairs.push_back({a, b});
    std::vector<std::size_t> level_of(pairs.size(), pairs.size());
    const auto found = levels_of(levels, pairs);
    for (std::size_t level = 0; level < found.size(); ++level) {
      EXPECT_TRUE(std::ranges::is_sorted(found[level]));
      std::set<std::uint32_t> met;
      for (const auto pair : found[level]) {
        EXPECT_EQ(level_of[pair], pairs.size()) << "a pair twice";
        level_of[pair] = level;
        EXPECT_TRUE(met.insert(pairs[pair].a).second && met.insert(pairs[pair].b).second);
      }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      std::size_t least = 0;
      for (std::size_t j = 0; j < i; ++j)
        if (pairs[j].a == pairs[i].a || pairs[j].b == pairs[i].b || pairs[j].b == pairs[i].a)
          least = std::max(least, level_of[j] + 1);
      EXPECT_EQ(level_of[i], least);
    }
  }
}

}  // namespace
}  // namespace lodestone
