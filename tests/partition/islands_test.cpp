// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Labels = std::vector<Region_index>;

Vertex_graph grid_graph(std::uint32_t columns, std::uint32_t rows) {
  return vertex_graph(columns * rows, grid_faces(columns, rows));
}

/// Labels of a strip two rows high, one per column.
Labels strip_labels(Labels columns) {
  Labels labels = columns;
  labels.insert(labels.end(), columns.begin(), columns.end());
  return labels;
}

TEST(Count_pieces, counts_connected_sets_of_one_label) {
  const auto graph = grid_graph(6, 2);
  EXPECT_EQ(count_pieces(graph, strip_labels({0, 0, 0, 0, 0, 0})), 1U);
  EXPECT_EQ(count_pieces(graph, strip_labels({0, 1, 0, 0, 1, 2})), 5U);
}

TEST(Count_pieces, skips_isolated_vertices) {
  const std::vector<Corners> faces{{1, 2, 4}};
  EXPECT_EQ(count_pieces(vertex_graph(6, faces), {0, 0, 1, 2, 1, 1}), 2U);
}

TEST(Repair_islands, connected_regions_are_unchanged) {
  const Labels before = strip_labels({2, 2, 0, 0, 1, 1});
  Labels labels = before;
  const auto repair = repair_islands(grid_graph(6, 2), labels, 3);
  EXPECT_EQ(labels, before);
  EXPECT_EQ(repair.regions, 3U);
  EXPECT_EQ(repair.islands_joined, 0U);
  EXPECT_EQ(repair.regions_added, 0U);
}

TEST(Repair_islands, an_island_joins_the_region_around_it) {
  Labels labels = strip_labels({0, 0, 0, 1, 0, 1, 1});
  EXPECT_EQ(repair_islands(grid_graph(7, 2), labels, 2).islands_joined, 2U);
  // Columns 5 and 6 are the larger piece of label 1; column 3 lies between pieces of label 0, column 4 beside it.
  EXPECT_EQ(labels, strip_labels({0, 0, 0, 0, 1, 1, 1}));
}

TEST(Repair_islands, an_island_joins_the_region_with_the_longest_border) {
  // Vertex 7 of a 5 x 3 grid is an island of label 2. Its neighbours are 1, 2, 6, 8, 12, 13.
  const auto graph = grid_graph(5, 3);
  Labels labels{0, 0, 1, 1, 2,  //
                0, 0, 2, 1, 2,  //
                0, 1, 1, 1, 2};
  EXPECT_EQ(repair_islands(graph, labels, 3).islands_joined, 1U);
  EXPECT_EQ(labels[7], 1U);  // four edges against two

  labels = {0, 0, 0, 1, 2,  //
            0, 0, 2, 1, 2,  //
            0, 0, 0, 1, 2};
  repair_islands(graph, labels, 3);
  EXPECT_EQ(labels[7], 0U);  // two edges against four
}

TEST(Repair_islands, equally_long_borders_are_decided_by_the_lowest_index) {
  const auto graph = grid_graph(5, 3);
  Labels labels{1, 1, 0, 0, 2,  //
                1, 1, 2, 0, 2,  //
                1, 1, 0, 0, 2};
  labels[12] = 1;  // 1, 6, 12 against 2, 8, 13
  repair_islands(graph, labels, 3);
  EXPECT_EQ(labels[7], 0U);
}

TEST(Repair_islands, an_island_behind_an_island_joins_too) {
  // The last column reaches a region only through the island before it.
  Labels labels = strip_labels({2, 2, 2, 0, 0, 0, 1, 1, 1, 1, 0, 2});
  const auto repair = repair_islands(grid_graph(12, 2), labels, 3);
  EXPECT_EQ(labels, strip_labels({2, 2, 2, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(repair.islands_joined, 2U);
  EXPECT_EQ(repair.regions, 3U);
}

TEST(Repair_islands, a_component_that_no_region_reaches_keeps_its_largest_piece_as_a_new_region) {
  auto faces = grid_faces(6, 2);
  for (auto face : grid_faces(5, 2)) {
    for (auto& corner : face) corner += 12;
    faces.push_back(face);
  }
  Labels labels = strip_labels({0, 0, 0, 1, 1, 1});
  const Labels second = strip_labels({0, 1, 1, 1, 0});
  labels.insert(labels.end(), second.begin(), second.end());
  const auto repair = repair_islands(vertex_graph(22, faces), labels, 2);
  EXPECT_EQ(repair.regions, 3U);
  EXPECT_EQ(repair.regions_added, 1U);
  // The second component has as many vertices of label 1 as the first: the earlier piece is the body.
  for (std::size_t v = 12; v < 22; ++v) EXPECT_EQ(labels[v], 2U);
  EXPECT_EQ(Labels(labels.begin(), labels.begin() + 12), strip_labels({0, 0, 0, 1, 1, 1}));
}

TEST(Repair_islands, leaves_every_region_of_random_labels_connected) {
  std::mt19937_64 random(1);
  const Numbered_mesh mesh([] {
    auto both = sphere(5);
    append(both, sphere(3, 1, {4, 0, 0}));
    return both;
  }());
  for (int trial = 0; trial < 50; ++trial) {
    const std::size_t regions = 1 + random() % 40;
    Labels labels(mesh.numbering.vertex_count());
    for (auto& label : labels) label = static_cast<Region_index>(random() % regions);
    for (Region_index region = 0; region < regions; ++region) labels[region] = region;
    const auto before = pieces_of(mesh.graph, labels, regions);
    const auto repair = repair_islands(mesh.graph, labels, regions);
    const auto after = pieces_of(mesh.graph, labels, repair.regions);
    std::size_t pieces_before = 0;
    for (const auto& pieces : before) pieces_before += pieces.size();
    for (std::size_t region = 0; region < repair.regions; ++region) {
      ASSERT_EQ(after[region].size(), 1U);
      if (region >= regions) continue;
      EXPECT_GE(after[region][0], std::ranges::max(before[region]));
    }
    EXPECT_EQ(repair.pieces_before, pieces_before);
    EXPECT_EQ(pieces_before, repair.regions + repair.islands_joined);
    EXPECT_EQ(repair.regions, regions + repair.regions_added);
  }
}

TEST(Repair_islands, isolated_vertices_keep_their_label) {
  const std::vector<Corners> faces{{0, 1, 2}};
  Labels labels{1, 1, 1, 0, 0};
  const auto repair = repair_islands(vertex_graph(5, faces), labels, 2);
  EXPECT_EQ(labels, (Labels{1, 1, 1, 0, 0}));
  EXPECT_EQ(repair.regions, 2U);
  EXPECT_EQ(repair.pieces_before, 1U);
}

TEST(Repair_islands, the_largest_components_become_regions_where_not_all_may) {
  std::vector<Corners> faces;
  std::uint32_t vertices = 0;
  for (int component = 0; component < 80; ++component, vertices += 3)
    faces.push_back({vertices, vertices + 1, vertices + 2});
  for (int component = 0; component < 40; ++component, vertices += 4) {
    faces.push_back({vertices, vertices + 1, vertices + 2});
    faces.push_back({vertices, vertices + 2, vertices + 3});
  }
  Labels labels(vertices, 0);
  const auto repair = repair_islands(vertex_graph(vertices, faces), labels, 1);
  EXPECT_EQ(repair.regions, 65U);
  std::set<Region_index> of_large(labels.begin() + 240, labels.end());
  EXPECT_EQ(of_large.size(), 40U);
}

TEST(Drop_regions_without_edges, renumbers_the_others_without_gaps) {
  const std::vector<Corners> faces{{0, 1, 2}, {2, 1, 3}};
  Labels labels{3, 3, 1, 1, 0, 2, 3};
  EXPECT_EQ(drop_regions_without_edges(vertex_graph(7, faces), labels, 4), 2U);
  EXPECT_EQ(labels, (Labels{1, 1, 0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace lodestone
