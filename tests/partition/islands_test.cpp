// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "partition/islands_of.h"
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

TEST(Islands_of, a_set_of_vertices_are_in_the_order_of_their_lowest_vertices_and_leave_the_buffer_clear) {
  // Of two rows of six vertices: the columns 0, 2 and 5, and vertex 9 beside column 2.
  const auto graph = grid_graph(6, 2);
  std::vector<bool> open(12, false);
  const std::vector<std::uint32_t> vertices{0, 2, 5, 6, 8, 9, 11};
  const std::vector<std::vector<std::uint32_t>> expected{{0, 6}, {2, 8, 9}, {5, 11}};
  EXPECT_EQ(islands_of(graph, vertices, open), expected);
  EXPECT_EQ(open, std::vector<bool>(12, false));
}

TEST(Count_parts, counts_connected_sets_of_one_label) {
  const auto graph = grid_graph(6, 2);
  EXPECT_EQ(count_parts(graph, strip_labels({0, 0, 0, 0, 0, 0})), 1U);
  EXPECT_EQ(count_parts(graph, strip_labels({0, 1, 0, 0, 1, 2})), 5U);
}

TEST(Count_parts, skips_isolated_vertices) {
  const std::vector<Corners> faces{{1, 2, 4}};
  EXPECT_EQ(count_parts(vertex_graph(6, faces), {0, 0, 1, 2, 1, 1}), 2U);
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
  // Columns 5 and 6 are the larger part of label 1; column 3 lies between parts of label 0, column 4 beside it.
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

TEST(Repair_islands, a_component_that_no_region_reaches_keeps_its_largest_part_as_a_new_region) {
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
  // The second component has as many vertices of label 1 as the first: the earlier part is the body.
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
    std::size_t parts_before = 0;
    for (const auto& parts : before) parts_before += parts.size();
    for (std::size_t region = 0; region < repair.regions; ++region) {
      ASSERT_EQ(after[region].size(), 1U);
      if (region >= regions) continue;
      EXPECT_GE(after[region][0], std::ranges::max(before[region]));
    }
    EXPECT_EQ(repair.parts_before, parts_before);
    EXPECT_EQ(parts_before, repair.regions + repair.islands_joined);
    EXPECT_EQ(repair.regions, regions + repair.regions_added);
  }
}

using Borders = std::vector<std::map<std::uint32_t, std::size_t>>;

/// Per part the number of edges to each other part.
Borders borders_of(const Vertex_graph& graph, const std::vector<std::uint32_t>& part) {
  Borders borders(part.size());
  for (std::uint32_t v = 0; v < part.size(); ++v)
    for (const auto w : neighbours(graph, v))
      if (part[v] != part[w]) ++borders[part[v]][part[w]];
  return borders;
}

/// The connected parts of the labels, each named by its lowest vertex, in ascending order of vertices.
std::vector<std::uint32_t> lowest_of_part(const Vertex_graph& graph, const Labels& labels) {
  std::vector<std::uint32_t> lowest(labels.size());
  std::iota(lowest.begin(), lowest.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t v = 0; v < labels.size(); ++v)
      for (const auto w : neighbours(graph, v))
        if (labels[v] == labels[w] && lowest[w] < lowest[v]) {
          lowest[v] = lowest[w];
          changed = true;
        }
  }
  return lowest;
}

/// Repairs islands by passes over all parts, on a connected mesh: every island beside a settled part joins it.
void repair_by_passes(const Vertex_graph& graph, Labels& labels, std::size_t regions) {
  const auto part = lowest_of_part(graph, labels);
  const auto borders = borders_of(graph, part);
  std::map<std::uint32_t, std::size_t> sizes;
  for (const auto p : part) ++sizes[p];
  std::set<std::uint32_t> settled;
  for (Region_index region = 0; region < regions; ++region) {
    std::pair<std::size_t, std::uint32_t> largest{0, 0};
    for (const auto& [p, size] : sizes)
      if (labels[p] == region && size > largest.first) largest = {size, p};
    if (largest.first > 0) settled.insert(largest.second);
  }
  while (settled.size() < sizes.size()) {
    std::vector<std::uint32_t> joined;
    for (const auto& [p, size] : sizes) {
      if (settled.contains(p)) continue;
      std::map<Region_index, std::size_t> lengths;
      for (const auto& [other, edges] : borders[p])
        if (settled.contains(other)) lengths[labels[other]] += edges;
      if (lengths.empty()) continue;
      labels[p] = std::ranges::max_element(lengths, {}, [](const auto& entry) { return entry.second; })->first;
      joined.push_back(p);
    }
    settled.insert(joined.begin(), joined.end());
  }
  for (std::size_t v = 0; v < labels.size(); ++v) labels[v] = labels[part[v]];
}

TEST(Repair_islands, gives_the_labels_of_passes_over_all_islands) {
  std::mt19937_64 random(3);
  for (const auto& surface : {sphere(8), potato(10), cube(5), grid(60, 2), grid(17, 11)}) {
    const Numbered_mesh mesh(surface);
    for (const std::size_t regions : {2, 3, 5, 12, 40})
      for (const std::size_t run : {1, 2, 9}) {
        // Runs of one label make parts of several sizes, and islands behind islands.
        Labels labels(mesh.numbering.vertex_count());
        for (std::size_t v = 0; v < labels.size(); ++v)
          labels[v] = v % run == 0 ? static_cast<Region_index>(random() % regions) : labels[v - 1];
        Labels expected = labels;
        repair_by_passes(mesh.graph, expected, regions);
        repair_islands(mesh.graph, labels, regions);
        EXPECT_EQ(labels, expected) << labels.size() << " vertices, " << regions << " regions, runs of " << run;
      }
  }
}

TEST(Repair_islands, a_long_row_of_islands_joins_from_its_end) {
  // Only the first two parts are regions: each of 200 000 islands lies behind the one before.
  Labels columns{0, 0, 1, 1};
  for (Region_index i = 0; i < 200000; ++i) columns.push_back(i % 2);
  Labels labels = strip_labels(columns);
  const auto repair = repair_islands(grid_graph(static_cast<std::uint32_t>(columns.size()), 2), labels, 2);
  EXPECT_EQ(repair.islands_joined, 200000U);
  std::ranges::fill(columns.begin() + 2, columns.end(), 1);
  EXPECT_EQ(labels, strip_labels(columns));
}

TEST(Repair_islands, isolated_vertices_keep_their_label) {
  const std::vector<Corners> faces{{0, 1, 2}};
  Labels labels{1, 1, 1, 0, 0};
  const auto repair = repair_islands(vertex_graph(5, faces), labels, 2);
  EXPECT_EQ(labels, (Labels{1, 1, 1, 0, 0}));
  EXPECT_EQ(repair.regions, 2U);
  EXPECT_EQ(repair.parts_before, 1U);
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

TEST(Repair_islands, tells_how_many_parts_stay_beyond_the_limit_of_regions) {
  // A strip with an island, and 100 loose triangles, of which 64 may become regions.
  std::vector<Corners> faces = grid_faces(6, 2);
  Labels labels = strip_labels({0, 0, 0, 1, 0, 1});
  for (int triangle = 0; triangle < 100; ++triangle) {
    const auto vertex = static_cast<std::uint32_t>(labels.size());
    faces.push_back({vertex, vertex + 1, vertex + 2});
    labels.resize(labels.size() + 3, 1);
  }
  const auto vertices = static_cast<std::uint32_t>(labels.size());
  const auto repair = repair_islands(vertex_graph(vertices, faces), labels, 2);
  EXPECT_EQ(repair.regions_added, 64U);
  EXPECT_EQ(repair.islands_left, 100U - 64 - 1);
  EXPECT_EQ(count_parts(vertex_graph(vertices, faces), labels), repair.regions + repair.islands_left);
}

TEST(Drop_regions_without_edges, renumbers_the_others_without_gaps) {
  const std::vector<Corners> faces{{0, 1, 2}, {2, 1, 3}};
  Labels labels{3, 3, 1, 1, 0, 2, 3};
  EXPECT_EQ(drop_regions_without_edges(vertex_graph(7, faces), labels, 4), 2U);
  EXPECT_EQ(labels, (Labels{1, 1, 0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace lodestone
