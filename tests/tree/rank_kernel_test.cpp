// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/rank_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "support/instruction_sets.h"

namespace lodestone::kernel {
namespace {

/// Numbers that all differ, in a random order: small ones, the smallest and largest there are, and any.
std::vector<std::uint32_t> different_numbers(std::size_t count, std::mt19937& random) {
  std::vector<std::uint32_t> numbers{0, 0xffffffffU, 0x7fffffffU, 0x80000000U};
  while (numbers.size() < 2 * count + 4) {
    numbers.push_back(static_cast<std::uint32_t>(random()));
    numbers.push_back(static_cast<std::uint32_t>(random() % 1000));
  }
  std::ranges::sort(numbers);
  numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
  std::ranges::shuffle(numbers, random);
  numbers.resize(count);
  return numbers;
}

TEST(Rank_kernel, gives_each_number_its_place_in_the_sorted_list) {
  for_instruction_sets([] {
    std::mt19937 random(1);
    for (std::size_t count = 0; count <= most_ranked; ++count) {
      const auto numbers = different_numbers(count, random);
      auto sorted = numbers;
      std::ranges::sort(sorted);
      Ranks ranks;
      find_ranks(numbers, ranks);
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(sorted[ranks[i]], numbers[i]) << i << " of " << count;
    }
  });
}

TEST(Rank_kernel, sorts) {
  for_instruction_sets([] {
    std::mt19937 random(2);
    for (std::size_t count = 0; count <= most_ranked; ++count) {
      auto numbers = different_numbers(count, random);
      auto sorted = numbers;
      std::ranges::sort(sorted);
      sort_few(numbers);
      ASSERT_EQ(numbers, sorted);
    }
  });
}

}  // namespace
}  // namespace lodestone::kernel
