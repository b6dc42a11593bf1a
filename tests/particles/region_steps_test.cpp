// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/region_steps.h"

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::vector<std::uint32_t> from(const Region_steps& steps, std::uint32_t vertex) {
  const auto reach = steps.from(vertex);
  return {reach.begin(), reach.end()};
}

TEST(Region_steps, reach_a_vertex_and_its_neighbours_in_ascending_order) {
  const Region_steps steps(vertex_graph(9, grid_faces(3, 3)), std::vector<Region_index>(9, 0));
  EXPECT_EQ(from(steps, 4), (std::vector<std::uint32_t>{0, 1, 3, 4, 5, 7, 8}));
  EXPECT_EQ(from(steps, 2), (std::vector<std::uint32_t>{1, 2, 5}));
}

TEST(Region_steps, never_leave_the_region) {
  const std::vector<Region_index> labels{0, 0, 1,  //
                                         0, 1, 1,  //
                                         2, 1, 1};
  const Region_steps steps(vertex_graph(9, grid_faces(3, 3)), labels);
  EXPECT_EQ(from(steps, 4), (std::vector<std::uint32_t>{4, 5, 7, 8}));
  EXPECT_EQ(from(steps, 0), (std::vector<std::uint32_t>{0, 1, 3}));
  EXPECT_EQ(from(steps, 6), (std::vector<std::uint32_t>{6}));
}

TEST(Region_steps, an_isolated_vertex_reaches_itself) {
  const std::vector<Corners> faces{{0, 1, 3}};
  const Region_steps steps(vertex_graph(4, faces), std::vector<Region_index>(4, 0));
  EXPECT_EQ(from(steps, 2), (std::vector<std::uint32_t>{2}));
}

}  // namespace
}  // namespace lodestone
