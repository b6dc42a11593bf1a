// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that every partition strategy must pass on any surface.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "partition/strategy_cases.h"
#include "partition/surface_soup.h"

namespace lodestone {

/// Number of vertices of each label.
template <class Strategy>
std::vector<std::size_t> label_sizes(const Strategy& strategy, const Surface_mesh& mesh, std::size_t regions) {
  return sizes_of(labels_of(strategy, mesh, regions));
}

/// Every connected surface gets exactly the requested number of regions, up to one per vertex.
template <class Strategy>
void expect_exact_counts(const Strategy& strategy) {
  for (const auto& mesh : {single_triangle(), tetrahedron(), grid(9, 2), cube(3), sphere(4), potato(6)})
    for (const std::size_t wanted : {1, 2, 3, 4, 6, 11, 17, 18, 66, 1000}) {
      const std::size_t regions = std::min<std::size_t>(wanted, mesh.number_of_vertices());
      const auto sizes = label_sizes(strategy, mesh, regions);
      EXPECT_EQ(sizes.size(), regions) << mesh.number_of_vertices() << " vertices";
      EXPECT_EQ(std::ranges::count(sizes, 0U), 0);
    }
}

/// Surfaces that break careless strategies.
std::vector<Surface_soup> odd_surfaces();

/// On any surface, every vertex gets a label below V, the same in each run, and `partition()` makes valid regions.
template <class Strategy>
void expect_odd_surfaces_labelled(const Strategy& strategy) {
  std::size_t number = 0;
  for (const auto& soup : odd_surfaces()) {
    SCOPED_TRACE("surface " + std::to_string(number++));
    const auto vertices = static_cast<std::size_t>(soup.positions.rows());
    for (const std::size_t regions : {std::size_t{1}, std::size_t{2}, std::size_t{5}, vertices}) {
      if (regions > vertices) continue;
      const auto labelling = strategy.label(soup.surface(), regions);
      ASSERT_EQ(labelling.labels.size(), vertices);
      for (const auto label : labelling.labels) ASSERT_LT(label, vertices);
      EXPECT_EQ(strategy.label(soup.surface(), regions).labels, labelling.labels);

      const auto result = finish_partition(soup.graph, soup.positions, soup.faces, labelling, regions, {});
      for (const auto& pieces : pieces_of(soup.graph, result.labels, result.regions)) EXPECT_LE(pieces.size(), 1U);
    }
  }
}

}  // namespace lodestone
