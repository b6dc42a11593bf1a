// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/metis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "partition/partition_checks.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

TEST(Metis, every_surface_gets_exactly_the_requested_regions) { expect_exact_counts(Metis{}); }

TEST(Metis, odd_surfaces_are_labelled) { expect_odd_surfaces_labelled(Metis{}); }

TEST(Metis, the_largest_part_exceeds_the_mean_by_no_more_than_the_imbalance) {
  const auto mesh = potato(40);
  const double mean = static_cast<double>(mesh.number_of_vertices()) / 16;
  for (const auto method : {Metis_method::k_way, Metis_method::recursive})
    for (const double imbalance : {0.01, 0.1}) {
      const auto sizes = label_sizes(Metis{.options = {.method = method, .imbalance = imbalance}}, mesh, 16);
      ASSERT_EQ(sizes.size(), 16U);
      // METIS rounds the bound up to whole vertices, and a recursion multiplies four such bounds.
      EXPECT_LE(static_cast<double>(std::ranges::max(sizes)), mean * std::pow(1 + imbalance, 4) + 1);
    }
}

TEST(Metis, a_strip_is_cut_across) {
  // Of all cuts of a strip of 3 x 64 vertices into equal halves the one across has the fewest edges: 3 + 2 diagonals.
  const auto mesh = grid(64, 3);
  const Numbered_mesh numbered(mesh);
  const auto labels = labels_of(Metis{}, mesh, 2);
  std::size_t cut = 0;
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    for (const auto w : neighbours(numbered.graph, v)) cut += v < w && labels[v] != labels[w] ? 1 : 0;
  EXPECT_EQ(cut, 5U);
}

TEST(Metis, depends_only_on_the_seed) {
  const auto mesh = potato(20);
  const auto with_seed = [&](std::uint64_t seed) { return labels_of(Metis{.options = {.seed = seed}}, mesh, 24); };
  EXPECT_EQ(with_seed(5), with_seed(5));
  std::set<std::vector<Region_index>> different;
  for (const std::uint64_t seed : {1, 2, 3, 4}) different.insert(with_seed(seed));
  EXPECT_GT(different.size(), 1U);
}

TEST(Metis, nothing_is_printed_whatever_the_number_of_regions) {
  testing::internal::CaptureStdout();
  for (const auto& mesh : {potato(4), grid(30, 2), cube(3)})
    for (std::size_t regions = 1; regions <= mesh.number_of_vertices(); ++regions) labels_of(Metis{}, mesh, regions);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Metis, options_out_of_range_are_refused) {
  for (const double imbalance : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(labels_of(Metis{.options = {.imbalance = imbalance}}, tetrahedron(), 2), Bad_argument);
  EXPECT_THROW(labels_of(Metis{.options = {.refinements = 0}}, tetrahedron(), 2), Bad_argument);
  EXPECT_THROW(labels_of(Metis{.options = {.vertices_a_part = 1}}, tetrahedron(), 2), Bad_argument);
  EXPECT_THROW(labels_of(Metis{}, tetrahedron(), 0), Bad_argument);
}

}  // namespace
}  // namespace lodestone
