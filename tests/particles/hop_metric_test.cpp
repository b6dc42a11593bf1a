// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/hop_metric.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// Hops between two vertices of a grid whose squares are cut from the lower left to the upper right: a step along the
/// cut moves in both directions at once, the other diagonal takes two steps.
std::uint32_t grid_hops(int dx, int dy) {
  const bool along_the_cut = (dx > 0) == (dy > 0);
  return static_cast<std::uint32_t>(along_the_cut ? std::max(std::abs(dx), std::abs(dy)) : std::abs(dx) + std::abs(dy));
}

TEST(Breadth_first_hops, are_the_fewest_edges_on_a_grid) {
  const int columns = 9, rows = 6;
  const auto graph = vertex_graph(columns * rows, grid_faces(columns, rows));
  for (int source = 0; source < columns * rows; source += 7) {
    const auto hops = breadth_first_hops(graph, static_cast<std::uint32_t>(source));
    for (int v = 0; v < columns * rows; ++v)
      EXPECT_EQ(hops[v], grid_hops(v % columns - source % columns, v / columns - source / columns)) << source << v;
  }
}

TEST(Breadth_first_hops, do_not_reach_other_components) {
  const std::vector<Corners> faces{{0, 1, 2}, {3, 4, 5}};
  const auto graph = vertex_graph(7, faces);
  EXPECT_EQ(breadth_first_hops(graph, 4),
            (std::vector<std::uint32_t>{unreached, unreached, unreached, 1, 0, 1, unreached}));
}

TEST(Hop_diameter, is_the_largest_distance_between_two_targets) {
  const auto graph = vertex_graph(30, grid_faces(6, 5));
  const std::vector<std::uint32_t> cut{0, 28}, across{5, 24}, three{0, 14, 28}, near{0, 1, 7};
  EXPECT_EQ(hop_diameter(graph, cut), 4U);     // (0, 0) to (4, 4)
  EXPECT_EQ(hop_diameter(graph, across), 9U);  // (5, 0) to (0, 4)
  EXPECT_EQ(hop_diameter(graph, three), 4U);
  EXPECT_EQ(hop_diameter(graph, near), 1U);
}

TEST(Hop_diameter, of_fewer_than_two_targets_is_0) {
  const auto graph = vertex_graph(30, grid_faces(6, 5));
  const std::vector<std::uint32_t> none, one{3};
  EXPECT_EQ(hop_diameter(graph, none), 0U);
  EXPECT_EQ(hop_diameter(graph, one), 0U);
}

TEST(Hop_diameter, ignores_pairs_in_different_components) {
  const std::vector<Corners> faces{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}};
  const auto graph = vertex_graph(7, faces);
  const std::vector<std::uint32_t> apart{0, 4}, both{0, 3, 4};
  EXPECT_EQ(hop_diameter(graph, apart), 0U);
  EXPECT_EQ(hop_diameter(graph, both), 2U);
}

TEST(Hop_diameter, is_the_largest_that_a_search_from_every_target_finds) {
  std::mt19937_64 random(1);
  auto pieces = potato(5);
  for (int i = 1; i < 4; ++i) append(pieces, grid(3 + i, 4));
  for (const auto& mesh : {sphere(8), potato(9), grid(30, 4), cube(5), pieces, tetrahedron()}) {
    const Numbered_mesh numbered(mesh);
    for (const std::size_t count : {2, 3, 9, 40}) {
      std::vector<std::uint32_t> targets;
      for (std::size_t i = 0; i < count; ++i)
        targets.push_back(static_cast<std::uint32_t>(random() % numbered.numbering.vertex_count()));
      std::size_t expected = 0;
      for (const auto a : targets) {
        const auto hops = breadth_first_hops(numbered.graph, a);
        for (const auto b : targets)
          if (hops[b] != unreached) expected = std::max<std::size_t>(expected, hops[b]);
      }
      EXPECT_EQ(hop_diameter(numbered.graph, targets), expected) << count;
    }
  }
}

/// Distances there are nearly the same, so that the triangle inequality decides little, and few vertices are ends of
/// the longest.
TEST(Hop_diameter, of_many_targets_in_a_random_graph_is_that_of_a_search_from_every_one) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    std::mt19937_64 random(seed);
    constexpr std::uint32_t vertices = 600;
    const auto any = [&] { return static_cast<std::uint32_t>(random() % vertices); };
    std::vector<Corners> faces;
    for (std::uint32_t v = 0; v + 2 < vertices; v += 2) faces.push_back({v, v + 1, v + 2});  // one component
    for (int i = 0; i < 300; ++i) faces.push_back({any(), any(), any()});
    const auto graph = vertex_graph(vertices, faces);
    std::vector<std::uint32_t> targets(vertices);
    std::iota(targets.begin(), targets.end(), 0U);
    std::size_t expected = 0;
    for (const auto target : targets)
      for (const auto hops : breadth_first_hops(graph, target))
        if (hops != unreached) expected = std::max<std::size_t>(expected, hops);
    EXPECT_EQ(hop_diameter(graph, targets), expected) << seed;
  }
}

TEST(Hop_diameter, of_a_mesh_is_that_of_its_graph) {
  const auto mesh = grid(6, 5);
  const std::vector<Surface_mesh::Vertex_index> targets{Surface_mesh::Vertex_index(5), Surface_mesh::Vertex_index(24)};
  EXPECT_EQ(hop_diameter(mesh, std::span<const Surface_mesh::Vertex_index>(targets)), 9U);
}

TEST(Hop_diameter, of_two_targets_beside_a_third_is_2) {
  const auto graph = vertex_graph(25, grid_faces(5, 5));
  const std::vector<std::uint32_t> targets{12, 11, 13};
  EXPECT_EQ(hop_diameter(graph, targets), 2U);
}

TEST(Hop_diameter, may_lie_in_any_component) {
  auto faces = grid_faces(9, 2);
  faces.push_back({18, 19, 20});
  const auto graph = vertex_graph(21, faces);
  const std::vector<std::uint32_t> targets{18, 0, 8};
  EXPECT_EQ(hop_diameter(graph, targets), 8U);
}

/// With a search per component, or more, this would take minutes if each compared all pairs of targets.
TEST(Hop_diameter, of_thousands_of_components_is_that_of_the_widest) {
  std::vector<Corners> faces;
  std::vector<std::uint32_t> targets;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const std::uint32_t v = 4 * i;
    faces.push_back({v, v + 1, v + 2});
    faces.push_back({v + 2, v + 1, v + 3});
    targets.push_back(v);
    if (i % 3 == 0) targets.push_back(v + 1);
  }
  const auto graph = vertex_graph(12'000, faces);
  EXPECT_EQ(hop_diameter(graph, targets), 1U);
  targets.push_back(4 * 2999 + 3);
  EXPECT_EQ(hop_diameter(graph, targets), 2U);
}

TEST(Hop_reach, is_the_diameter_of_targets_that_are_not_alone) {
  const auto graph = vertex_graph(30, grid_faces(6, 5));
  const std::vector<std::uint32_t> none, three{0, 14, 28};
  EXPECT_EQ(hop_reach(graph, none), 0U);
  EXPECT_EQ(hop_reach(graph, three), 4U);
}

TEST(Hop_reach, of_a_target_that_is_alone_is_how_far_its_component_reaches) {
  // Four faces in a row, and one.
  const std::vector<Corners> faces{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {6, 7, 8}};
  const auto graph = vertex_graph(9, faces);
  const std::vector<std::uint32_t> end{0}, each{0, 7}, pair_and_alone{6, 8, 0};
  EXPECT_EQ(hop_reach(graph, end), 3U);
  EXPECT_EQ(hop_reach(graph, each), 3U);
  EXPECT_EQ(hop_reach(graph, pair_and_alone), 3U);
}

}  // namespace
}  // namespace lodestone
