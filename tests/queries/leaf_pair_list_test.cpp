// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/leaf_pair_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace lodestone {
namespace {

TEST(Leaf_pair_list, keeps_each_pair_once_in_the_order_of_adding) {
  std::mt19937_64 random(1);
  Leaf_pair_list list;
  EXPECT_FALSE(list.contains({0, 0}));
  for (const std::uint32_t leaves : {3, 40, 2000, 5}) {
    list.clear();
    EXPECT_TRUE(list.pairs().empty());
    std::set<Leaf_pair> known;
    std::vector<Leaf_pair> in_order;
    for (std::size_t count = 0; count < 3000; ++count) {
      const Leaf_pair pair{static_cast<std::uint32_t>(random() % leaves),
                           static_cast<std::uint32_t>(random() % leaves)};
      EXPECT_EQ(list.contains(pair), known.contains(pair));
      const bool is_new = known.insert(pair).second;
      EXPECT_EQ(list.add(pair), is_new);
      if (is_new) in_order.push_back(pair);
    }
    EXPECT_TRUE(std::ranges::equal(list.pairs(), in_order));
  }
}

TEST(Leaf_pair_list, tells_the_two_leaves_of_a_pair_apart) {
  Leaf_pair_list list;
  EXPECT_TRUE(list.add({1, 2}));
  EXPECT_FALSE(list.contains({2, 1}));
  EXPECT_TRUE(list.add({2, 1}));
  EXPECT_FALSE(list.add({1, 2}));
  list.clear();
  EXPECT_FALSE(list.contains({1, 2}));
  EXPECT_TRUE(list.add({1, 2}));
}

}  // namespace
}  // namespace lodestone
