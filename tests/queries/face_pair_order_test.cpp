// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/face_pair_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace lodestone {
namespace {

TEST(Face_pair_order, is_that_of_comparing_pairs) {
  std::mt19937_64 random(1);
  for (const std::size_t count : {0, 1, 2, 31, 32, 33, 300, 5000})
    for (const int bits_a : {0, 1, 7, 8, 9, 16, 31, 32})
      for (const int bits_b : {0, 1, 8, 15, 17, 24, 32}) {
        const auto index = [&](int bits) {
          return static_cast<std::uint32_t>(bits == 0 ? 0 : random() >> (64 - bits));
        };
        std::vector<Face_pair> pairs(count);
        for (auto& pair : pairs) pair = {index(bits_a), index(bits_b)};
        auto expected = pairs;
        std::ranges::sort(expected);
        sort_face_pairs(pairs);
        ASSERT_EQ(pairs, expected) << count << ' ' << bits_a << ' ' << bits_b;
      }
}

TEST(Face_pair_order, holds_up_to_the_largest_indices) {
  constexpr std::uint32_t most = 0xffffffff;
  std::vector<Face_pair> pairs(100, {most, most});
  pairs[50] = {most, 0};
  pairs[99] = {0, most};
  auto expected = pairs;
  std::ranges::sort(expected);
  sort_face_pairs(pairs);
  EXPECT_EQ(pairs, expected);
}

}  // namespace
}  // namespace lodestone
