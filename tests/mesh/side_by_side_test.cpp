// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/side_by_side.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace lodestone {
namespace {

/// How many workers shared each item.
std::vector<std::size_t> shares_of(std::vector<std::size_t> sizes, std::size_t threads,
                                   std::size_t shared_from = 1000) {
  Workers workers(threads);
  std::vector<std::atomic<std::size_t>> shares(sizes.size());
  side_by_side(
      sizes, workers, [&](std::size_t i, Workers& those) { shares[i] += those.count(); }, shared_from);
  return {shares.begin(), shares.end()};
}

TEST(Side_by_side, items_of_like_sizes_get_a_worker_each_and_those_left_over_get_all) {
  if (Workers(2).count() < 2) GTEST_SKIP() << "the machine has one processor";
  using Shares = std::vector<std::size_t>;
  EXPECT_EQ(shares_of({}, 2), (Shares{}));
  EXPECT_EQ(shares_of({5}, 2), (Shares{2}));
  EXPECT_EQ(shares_of({5, 5}, 2), (Shares{1, 1}));
  EXPECT_EQ(shares_of({5, 5, 5}, 2), (Shares{1, 1, 2}));
  EXPECT_EQ(shares_of({5, 6, 7, 5}, 2), (Shares{1, 1, 1, 1}));
}

TEST(Side_by_side, an_item_that_outweighs_the_others_is_shared_by_all) {
  if (Workers(2).count() < 2) GTEST_SKIP() << "the machine has one processor";
  using Shares = std::vector<std::size_t>;
  EXPECT_EQ(shares_of({3, 1}, 2), (Shares{1, 1}));
  EXPECT_EQ(shares_of({4, 1}, 2), (Shares{2, 2}));
  EXPECT_EQ(shares_of({0, 0}, 2), (Shares{1, 1}));
  EXPECT_EQ(shares_of({100, 1, 1, 1}, 2), (Shares{2, 2, 2, 2}));
}

TEST(Side_by_side, items_that_are_shared_well_get_all_and_the_others_are_as_without_them) {
  if (Workers(2).count() < 2) GTEST_SKIP() << "the machine has one processor";
  using Shares = std::vector<std::size_t>;
  EXPECT_EQ(shares_of({7, 7}, 2, 7), (Shares{2, 2}));
  EXPECT_EQ(shares_of({5, 7, 5, 100, 5}, 2, 7), (Shares{1, 2, 1, 2, 2}));
  EXPECT_EQ(shares_of({5, 7, 1}, 2, 7), (Shares{2, 2, 2}));
}

TEST(Side_by_side, a_single_worker_takes_the_items_in_order) {
  Workers workers(1);
  std::vector<std::size_t> order;
  const std::size_t sizes[] = {1, 1, 1};
  side_by_side(sizes, workers, [&](std::size_t i, Workers&) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Side_by_side, the_first_item_that_fails_is_told) {
  for (const std::size_t threads : {1, 2}) {
    Workers workers(threads);
    const std::size_t sizes[] = {1, 1, 1, 1, 1};
    try {
      side_by_side(sizes, workers, [](std::size_t i, Workers&) {
        if (i >= 1) throw std::runtime_error("item " + std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "item 1");
    }
  }
}

}  // namespace
}  // namespace lodestone
