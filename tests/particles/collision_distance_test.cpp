// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/collision_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

double distance_on(const Surface_mesh& mesh, Distance_measure measure = Distance_measure::adjacent_vertices) {
  const Numbered_mesh numbered(mesh);
  return collision_distance(numbered.graph, numbered.positions, measure);
}

TEST(Collision_distance, is_the_mean_edge_length_with_each_edge_once) {
  // A unit square: four sides and one diagonal, which two faces share.
  EXPECT_DOUBLE_EQ(distance_on(grid(2, 2)), (4 + std::sqrt(2)) / 5);
  EXPECT_DOUBLE_EQ(distance_on(tetrahedron()), (3 + 3 * std::sqrt(2)) / 6);
}

TEST(Collision_distance, of_all_vertices_is_the_mean_over_all_pairs) {
  EXPECT_DOUBLE_EQ(distance_on(grid(2, 2), Distance_measure::all_vertices), (4 + 2 * std::sqrt(2)) / 6);
  auto pair = single_triangle();
  deform(pair, [](const Point& p) { return Point(3 * p.x(), 4 * p.y(), 0); });
  EXPECT_DOUBLE_EQ(distance_on(pair, Distance_measure::all_vertices), (3 + 4 + 5) / 3.0);
}

TEST(Collision_distance, skips_isolated_vertices) {
  for (const auto measure : {Distance_measure::adjacent_vertices, Distance_measure::all_vertices}) {
    auto mesh = grid(2, 2);
    const double before = distance_on(mesh, measure);
    mesh.add_vertex({1000, 0, 0});
    EXPECT_EQ(distance_on(mesh, measure), before);
  }
}

TEST(Collision_distance, of_all_vertices_is_about_the_size_of_the_object) {
  const double edge = distance_on(sphere(16));
  const double any = distance_on(sphere(16), Distance_measure::all_vertices);
  EXPECT_LT(edge, 0.2);
  EXPECT_NEAR(any, 4 / 3.0, 0.05);  // mean chord of the unit sphere
}

TEST(Collision_distance, has_the_unit_of_the_positions) {
  auto mesh = potato(4);
  for (const auto measure : {Distance_measure::adjacent_vertices, Distance_measure::all_vertices}) {
    auto scaled = mesh;
    scale(scaled, 1024);
    EXPECT_DOUBLE_EQ(distance_on(scaled, measure), 1024 * distance_on(mesh, measure));
  }
}

}  // namespace
}  // namespace lodestone
