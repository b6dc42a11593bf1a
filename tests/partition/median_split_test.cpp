// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/median_split.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "partition/strategy_cases.h"

namespace lodestone {
namespace {

TEST(Median_split, sizes_differ_by_at_most_one_for_powers_of_two) {
  for (const auto& mesh : {grid(7, 5), grid(9, 9), grid(2, 50), potato(4), potato(7)})
    for (std::size_t regions = 1; regions <= mesh.number_of_vertices(); regions *= 2) {
      const auto sizes = sizes_of(labels_of(Median_split{}, mesh, regions));
      EXPECT_EQ(sizes.size(), regions);
      EXPECT_LE(*std::ranges::max_element(sizes) - *std::ranges::min_element(sizes), 1U);
    }
}

TEST(Median_split, no_part_is_more_than_twice_another) {
  for (const std::size_t regions : {3, 5, 6, 7, 12, 33, 100}) {
    const auto sizes = sizes_of(labels_of(Median_split{}, potato(8), regions));  // 258 vertices
    EXPECT_EQ(sizes.size(), regions);
    EXPECT_LE(*std::ranges::max_element(sizes), 2 * *std::ranges::min_element(sizes) + 1);
  }
}

TEST(Median_split, splits_the_longest_axis_first) {
  // 8 x 4 vertices: across into two squares, then, both axes being equal, across again, the lower part first.
  const auto labels = labels_of(Median_split{}, grid(8, 4), 3);
  for (std::uint32_t v = 0; v < 32; ++v) {
    const auto x = v % 8;
    EXPECT_EQ(labels[v], x >= 4 ? 1U : x >= 2 ? 2U : 0U) << v;
  }
}

TEST(Median_split, coinciding_vertices_are_split_by_index) {
  auto mesh = grid(4, 4);
  deform(mesh, [](const Point&) { return Point(1, 1, 1); });
  const auto labels = labels_of(Median_split{}, mesh, 4);
  for (std::uint32_t v = 0; v < 16; ++v) EXPECT_EQ(labels[v], (std::array{0U, 2U, 1U, 3U}[v / 4])) << v;
}

TEST(Median_split, an_odd_vertex_stays_below) {
  EXPECT_EQ(sizes_of(labels_of(Median_split{}, grid(3, 3), 2)), (std::vector<std::size_t>{5, 4}));
}

TEST(Median_split, is_in_the_registry) { expect_in_registry(Median_split{}, {}); }

TEST(Median_split, divides_awkward_meshes) {
  expect_sound_on_awkward_meshes(Median_split{}, always_as_wanted);
  expect_invariant_under_translation_and_scale(Median_split{});
}

}  // namespace
}  // namespace lodestone
