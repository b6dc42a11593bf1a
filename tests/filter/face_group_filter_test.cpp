// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/filter/face_group_filter.h"

#include <gtest/gtest.h>

#include "filter/filter_checks.h"
#include "support/hard_pairs.h"

namespace lodestone {
namespace {

/// The candidates of two leaves, as groups, sorted. Checks that every instruction set gives the same.
Face_pairs group_candidates(const Single_leaf& a, const Single_leaf& b) {
  Face_group_filter filter;
  std::vector<Face_pairs> answers;
  for_instruction_sets([&] {
    filter.begin(a.view().coordinates, a.view().tree->volume(0), b.view().coordinates, b.view().tree->volume(0));
    Face_pairs& pairs = answers.emplace_back();
    for (const auto& candidate : filter.face_candidates(a.faces(), b.faces()))
      pairs.push_back({candidate.a, candidate.b});
  });
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
  std::ranges::sort(answers[0]);
  return answers[0];
}

TEST(Face_group_filter, keeps_the_pairs_that_the_filter_of_leaves_keeps) {
  std::size_t kept = 0, dropped = 0;
  Hard_pairs hard(3);
  for (const auto& kind : Hard_pairs::kinds())
    for (const auto& placement : placements)
      for (const std::uint32_t size : {1U, 2U, 7U, 32U, 64U, 128U}) {
        SCOPED_TRACE(testing::Message() << kind.name << ", scale " << placement.scale << ", offset " << placement.offset
                                        << ", " << size << " faces");
        Single_leaf a(size), b(size);
        for (std::uint32_t i = 0; i < size; ++i) {
          const auto [s, t] = (hard.*kind.make)();
          a.set(i, placed(s, placement)), b.set(i, placed(t, placement));
        }
        a.refit(), b.refit();
        const Face_pairs pairs = group_candidates(a, b);
        EXPECT_EQ(pairs, candidate_pairs(a.view(), b.view(), 0));
        kept += pairs.size(), dropped += std::size_t{size} * size - pairs.size();
      }
  EXPECT_GT(kept, 1000U);
  EXPECT_GT(dropped, kept);
}

TEST(Face_group_filter, takes_groups_of_different_sizes_one_after_the_other) {
  Single_leaf large(128), small(3);
  Hard_pairs hard(4);
  const auto anywhere = Hard_pairs::kinds().front();
  for (std::uint32_t i = 0; i < 128; ++i) {
    const auto [s, t] = (hard.*anywhere.make)();
    large.set(i, s);
    if (i < 3) small.set(i, t);
  }
  large.refit(), small.refit();
  Face_group_filter filter;
  filter.begin(large.view().coordinates, large.view().tree->volume(0), small.view().coordinates,
               small.view().tree->volume(0));
  const auto count = [&](std::size_t of_large, std::size_t of_small) {
    return filter.face_candidates(large.faces().first(of_large), small.faces().first(of_small)).size();
  };
  const std::size_t all = count(128, 3);
  EXPECT_GT(all, 0U);
  EXPECT_LE(count(1, 1), 1U);
  EXPECT_EQ(count(128, 3), all);
  EXPECT_LE(count(5, 3), all);
}

}  // namespace
}  // namespace lodestone
