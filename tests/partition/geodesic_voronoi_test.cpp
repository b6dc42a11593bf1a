// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/geodesic_voronoi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lodestone/mesh/errors.h"
#include "partition/geodesic_oracle.h"
#include "partition/strategy_cases.h"

namespace lodestone {
namespace {

/// The first of the nearest seeds by the plain method; a seed belongs to itself.
std::vector<Region_index> nearest_seeds(const Numbered_mesh& mesh, const std::vector<std::uint32_t>& seeds) {
  std::vector<Region_index> nearest(mesh.numbering.vertex_count(), Geodesic_voronoi::no_seed);
  std::vector<double> least(nearest.size(), std::numeric_limits<double>::infinity());
  for (Region_index seed = 0; seed < seeds.size(); ++seed) {
    const auto distance = plain_distances(mesh.graph, mesh.positions, seeds[seed]);
    for (std::size_t v = 0; v < nearest.size(); ++v)
      if (distance[v] < least[v]) {
        least[v] = distance[v];
        nearest[v] = seed;
      }
  }
  for (Region_index seed = 0; seed < seeds.size(); ++seed) nearest[seeds[seed]] = seed;
  return nearest;
}

void expect_cells(const Geodesic_voronoi& cells, const Numbered_mesh& mesh, const std::vector<std::uint32_t>& seeds) {
  const auto nearest = nearest_seeds(mesh, seeds);
  const auto distances = plain_distances_to_nearest(mesh.graph, mesh.positions, seeds);
  EXPECT_EQ(cells.seeds(), seeds);
  for (std::uint32_t v = 0; v < nearest.size(); ++v) {
    EXPECT_EQ(cells.distance(v), distances[v]) << v;
    EXPECT_EQ(cells.nearest_seed(v), nearest[v]) << v;
  }
}

TEST(Geodesic_voronoi, equals_relaxing_all_edges_from_every_seed) {
  const Numbered_mesh mesh(potato(6));
  const std::vector<std::uint32_t> seeds{3, 77, 20, 100, 145};
  Geodesic_voronoi cells(mesh.graph, mesh.positions);
  cells.add(seeds);
  expect_cells(cells, mesh, seeds);
}

TEST(Geodesic_voronoi, seeds_added_one_by_one_give_the_same_cells_as_all_at_once) {
  const Numbered_mesh mesh(potato(6));
  Geodesic_voronoi cells(mesh.graph, mesh.positions);
  std::vector<std::uint32_t> seeds;
  for (const std::uint32_t seed : {50, 3, 77, 20, 100, 145, 2}) {
    seeds.push_back(seed);
    cells.add({&seed, 1});
    expect_cells(cells, mesh, seeds);
  }
}

TEST(Geodesic_voronoi, equally_near_vertices_belong_to_the_first_seed) {
  // A grid of unit squares, whose paths along the axes are sums of whole numbers.
  const Numbered_mesh mesh(grid(9, 2));
  for (const auto& seeds : {std::vector<std::uint32_t>{0, 8}, std::vector<std::uint32_t>{8, 0}}) {
    Geodesic_voronoi cells(mesh.graph, mesh.positions);
    cells.add(seeds);
    EXPECT_EQ(cells.nearest_seed(4), 0U);
    EXPECT_EQ(cells.distance(4), 4);
    expect_cells(cells, mesh, seeds);
  }
}

TEST(Geodesic_voronoi, a_seed_belongs_to_itself_where_all_vertices_coincide) {
  auto point = sphere(3);
  deform(point, [](const Point&) { return Point(1, 2, 3); });
  const Numbered_mesh mesh(point);
  Geodesic_voronoi together(mesh.graph, mesh.positions), single(mesh.graph, mesh.positions);
  const std::vector<std::uint32_t> seeds{7, 2, 30};
  together.add(seeds);
  for (const auto seed : seeds) single.add({&seed, 1});
  for (Region_index seed = 0; seed < 3; ++seed) {
    EXPECT_EQ(together.nearest_seed(seeds[seed]), seed);
    EXPECT_EQ(single.nearest_seed(seeds[seed]), seed);
  }
}

TEST(Geodesic_voronoi, cells_of_seeds_added_at_once_are_connected) {
  auto point = sphere(4);
  deform(point, [](const Point& p) { return Point(std::round(2 * p.x()), 0, 0); });
  for (const auto& surface : {point, grid(8, 8), potato(5)}) {
    const Numbered_mesh mesh(surface);
    std::vector<std::uint32_t> seeds;
    for (std::uint32_t v = 0; v < mesh.numbering.vertex_count(); v += 5) seeds.push_back(v);
    Geodesic_voronoi cells(mesh.graph, mesh.positions);
    cells.add(seeds);
    for (const auto& pieces : pieces_of(mesh.graph, cells.labels(), seeds.size())) EXPECT_EQ(pieces.size(), 1U);
  }
}

TEST(Geodesic_voronoi, a_component_without_a_seed_falls_to_the_seed_nearest_in_a_straight_line) {
  auto surface = grid(10, 2);
  auto above = grid(10, 2);
  shift(above, 0, 0, 1);
  append(surface, above);
  surface.add_vertex({30, 0, 0});
  const Numbered_mesh mesh(surface);
  Geodesic_voronoi cells(mesh.graph, mesh.positions);
  cells.add(std::vector<std::uint32_t>{0, 9});
  const auto labels = cells.labels();
  for (std::uint32_t v = 20; v < 41; ++v) {
    EXPECT_EQ(cells.nearest_seed(v), Geodesic_voronoi::no_seed);
    EXPECT_EQ(cells.distance(v), std::numeric_limits<double>::infinity());
    EXPECT_EQ(labels[v], v == 40 || (v - 20) % 10 >= 5 ? 1U : 0U) << v;
  }
}

TEST(Geodesic_voronoi, forgets_its_seeds) {
  const Numbered_mesh mesh(potato(4));
  Geodesic_voronoi cells(mesh.graph, mesh.positions);
  cells.add(std::vector<std::uint32_t>{1, 2, 3});
  cells.clear();
  EXPECT_FALSE(cells.is_seed(1));
  cells.add(std::vector<std::uint32_t>{40, 3});
  expect_cells(cells, mesh, {40, 3});
}

TEST(Geodesic_voronoi, refuses_seeds_that_are_not_vertices_or_already_seeds) {
  const Numbered_mesh mesh(tetrahedron());
  Geodesic_voronoi cells(mesh.graph, mesh.positions);
  EXPECT_THROW(cells.add(std::vector<std::uint32_t>{4}), Bad_argument);
  cells.add(std::vector<std::uint32_t>{2});
  EXPECT_THROW(cells.add(std::vector<std::uint32_t>{2}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
