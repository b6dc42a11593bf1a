// SPDX-License-Identifier: GPL-3.0-or-later
#include "soak/soak.h"

#include <gtest/gtest.h>

namespace lodestone {
namespace {

TEST(Soak, a_short_run_finds_no_difference_in_any_kind_of_mesh_and_can_be_repeated) {
  const auto result = soak(7, 1), again = soak(7, 1);
  EXPECT_EQ(result.differences, 0U);
  EXPECT_EQ(result.invalid_trees, 0U);
  ASSERT_EQ(result.kinds.size(), 8U);
  std::size_t pairs = 0, intersecting = 0;
  for (const auto& kind : result.kinds) {
    EXPECT_EQ(kind.rounds, 6U) << kind.name;
    EXPECT_GT(kind.pairs, 5000U) << kind.name;
    EXPECT_GT(kind.intersecting, 20U) << kind.name;
    pairs += kind.pairs;
    intersecting += kind.intersecting;
  }
  EXPECT_EQ(result.pairs, pairs);
  EXPECT_EQ(result.intersecting, intersecting);
  EXPECT_GT(pairs, 500'000U);
  EXPECT_EQ(again.pairs, result.pairs);
  EXPECT_EQ(again.intersecting, result.intersecting);
}

TEST(Soak, checks_at_least_the_requested_pairs_and_reports_its_progress) {
  std::size_t last = 0;
  const auto result = soak(9, 600'000, [&](std::size_t done) {
    EXPECT_GE(done, last);
    last = done;
  });
  EXPECT_GE(result.pairs, 600'000U);
  EXPECT_GE(last, 600'000U);
  EXPECT_LE(last, result.pairs);
  EXPECT_EQ(result.differences, 0U);
  for (const auto& kind : result.kinds) EXPECT_GE(kind.pairs, 75'000U) << kind.name;
}

TEST(Soak, is_the_sum_of_its_kinds_in_any_order) {
  const auto whole = soak(5, 1);
  ASSERT_EQ(whole.kinds.size(), soak_kinds());
  for (std::size_t kind = soak_kinds(); kind-- > 0;) {
    const auto alone = soak_one_kind(5, kind, 1);
    EXPECT_EQ(alone.name, whole.kinds[kind].name);
    EXPECT_EQ(alone.pairs, whole.kinds[kind].pairs);
    EXPECT_EQ(alone.intersecting, whole.kinds[kind].intersecting);
  }
}

}  // namespace
}  // namespace lodestone
