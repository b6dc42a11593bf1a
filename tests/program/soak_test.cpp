// SPDX-License-Identifier: GPL-3.0-or-later
#include "soak.h"

#include <gtest/gtest.h>

namespace lodestone {
namespace {

TEST(Soak, a_short_one_finds_no_difference_in_any_kind_of_mesh) {
  const auto result = soak(7, 600'000);
  EXPECT_GE(result.pairs, 600'000U);
  EXPECT_EQ(result.differences, 0U);
  EXPECT_EQ(result.invalid_trees, 0U);
  ASSERT_EQ(result.kinds.size(), 6U);
  std::size_t pairs = 0;
  for (const auto& kind : result.kinds) {
    EXPECT_GE(kind.rounds, 4U) << kind.name;
    EXPECT_GE(kind.pairs, 100'000U) << kind.name;
    EXPECT_GT(kind.intersecting, 100U) << kind.name;
    EXPECT_EQ(kind.differences, 0U) << kind.name;
    pairs += kind.pairs;
  }
  EXPECT_EQ(result.pairs, pairs);
}

TEST(Soak, is_the_same_for_one_seed_and_another_for_another) {
  const auto first = soak(3, 1), again = soak(3, 1), other = soak(4, 1);
  EXPECT_EQ(first.pairs, again.pairs);
  EXPECT_EQ(first.intersecting, again.intersecting);
  EXPECT_NE(first.pairs, other.pairs);
}

}  // namespace
}  // namespace lodestone
