// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/random_voronoi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "partition/geodesic_oracle.h"
#include "partition/strategy_cases.h"

namespace lodestone {
namespace {

TEST(Random_vertices, are_distinct_and_as_many_as_requested) {
  const Numbered_mesh mesh(sphere(3));
  for (const std::size_t count : {0, 1, 5, 37, 38, 50}) {
    const auto drawn = random_vertices(mesh.graph, count, 1);
    EXPECT_EQ(drawn.size(), std::min<std::size_t>(count, 38));
    EXPECT_EQ(std::set<std::uint32_t>(drawn.begin(), drawn.end()).size(), drawn.size());
    for (const auto v : drawn) EXPECT_LT(v, 38U);
  }
}

TEST(Random_vertices, have_edges_as_long_as_any_such_vertices_are_left) {
  auto surface = sphere(1);
  for (int i = 0; i < 20; ++i) surface.add_vertex({1.0 * i, 0, 0});
  const Numbered_mesh mesh(surface);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto drawn = random_vertices(mesh.graph, 8, seed);
    ASSERT_EQ(drawn.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(drawn[i] < 6, i < 6) << seed;
  }
}

TEST(Random_vertices, every_vertex_is_drawn_equally_often) {
  const Numbered_mesh mesh(sphere(2));  // 18 vertices
  std::vector<int> drawn(18, 0);
  for (std::uint64_t seed = 0; seed < 6000; ++seed)
    for (const auto v : random_vertices(mesh.graph, 3, seed)) ++drawn[v];
  // Binomial with n = 6000 and p = 1/6: mean 1000, deviation 29.
  for (const int count : drawn) EXPECT_NEAR(count, 1000, 5 * 29);
}

TEST(Random_voronoi, regions_are_the_vertices_nearest_to_the_seeds) {
  const auto surface = potato(6);
  const Numbered_mesh mesh(surface);
  const auto labels = labels_of(Random_voronoi{.options = {.seed = 5}}, surface, 12);
  const auto seeds = random_vertices(mesh.graph, 12, 5);
  const auto nearest = plain_distances_to_nearest(mesh.graph, mesh.positions, seeds);
  for (Region_index seed = 0; seed < seeds.size(); ++seed) {
    const auto distances = plain_distances(mesh.graph, mesh.positions, seeds[seed]);
    for (std::size_t v = 0; v < labels.size(); ++v) {
      if (labels[v] != seed) continue;
      EXPECT_EQ(distances[v], nearest[v]) << v;
    }
  }
}

TEST(Random_voronoi, depends_on_the_seed) {
  const auto mesh = potato(6);
  std::set<std::vector<Region_index>> different_labels;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    different_labels.insert(labels_of(Random_voronoi{.options = {.seed = seed}}, mesh, 8));
  EXPECT_EQ(different_labels.size(), 10U);
}

TEST(Random_voronoi, is_in_the_registry) { expect_in_registry(Random_voronoi{.options = {.seed = 3}}, {.seed = 3}); }

TEST(Random_voronoi, divides_awkward_meshes) {
  expect_sound_on_awkward_meshes(Random_voronoi{}, always_as_wanted);
  expect_invariant_under_translation_and_scale(Random_voronoi{});
}

}  // namespace
}  // namespace lodestone
