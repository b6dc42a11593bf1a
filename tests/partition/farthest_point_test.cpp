// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/farthest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lodestone/partition/random_voronoi.h"
#include "partition/geodesic_oracle.h"
#include "partition/strategy_cases.h"

namespace lodestone {
namespace {

/// The largest distance from a vertex to the nearest of `centres`.
double radius(const std::vector<std::vector<double>>& distances, const std::vector<std::uint32_t>& centres) {
  double largest = 0;
  for (std::size_t v = 0; v < distances.size(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto centre : centres) nearest = std::min(nearest, distances[centre][v]);
    largest = std::max(largest, nearest);
  }
  return largest;
}

std::vector<std::vector<double>> all_distances(const Numbered_mesh& mesh) {
  std::vector<std::vector<double>> distances;
  for (std::uint32_t v = 0; v < mesh.numbering.vertex_count(); ++v)
    distances.push_back(plain_distances(mesh.graph, mesh.positions, v));
  return distances;
}

TEST(Farthest_points, each_is_the_first_of_the_vertices_farthest_from_all_before) {
  for (const auto& surface : {potato(5), grid(9, 7)}) {
    const Numbered_mesh mesh(surface);
    const auto points = farthest_points(mesh.graph, mesh.positions, 15, 3);
    ASSERT_EQ(points.size(), 15U);
    for (std::size_t n = 1; n < points.size(); ++n) {
      const auto distances =
          plain_distances_to_nearest(mesh.graph, mesh.positions, {points.begin(), points.begin() + n});
      EXPECT_EQ(points[n], std::ranges::max_element(distances) - distances.begin()) << n;
    }
  }
}

TEST(Farthest_points, the_first_is_drawn_by_the_seed) {
  const Numbered_mesh mesh(potato(5));
  std::set<std::uint32_t> first;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    first.insert(farthest_points(mesh.graph, mesh.positions, 4, seed)[0]);
    EXPECT_EQ(farthest_points(mesh.graph, mesh.positions, 4, seed),
              farthest_points(mesh.graph, mesh.positions, 4, seed));
  }
  EXPECT_GT(first.size(), 20U);
}

TEST(Farthest_points, cover_within_twice_the_radius_of_the_best_choice) {
  const Numbered_mesh mesh(potato(2));
  const auto distances = all_distances(mesh);
  double best_pair = std::numeric_limits<double>::infinity(), best_triple = best_pair;
  for (std::uint32_t a = 0; a < distances.size(); ++a)
    for (std::uint32_t b = 0; b < a; ++b) {
      best_pair = std::min(best_pair, radius(distances, {a, b}));
      for (std::uint32_t c = 0; c < b; ++c) best_triple = std::min(best_triple, radius(distances, {a, b, c}));
    }
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_LE(radius(distances, farthest_points(mesh.graph, mesh.positions, 2, seed)), 2 * best_pair);
    EXPECT_LE(radius(distances, farthest_points(mesh.graph, mesh.positions, 3, seed)), 2 * best_triple);
  }
}

TEST(Farthest_points, lie_no_nearer_to_each_other_than_the_farthest_vertex_lies_to_them) {
  const Numbered_mesh mesh(potato(5));
  const auto distances = all_distances(mesh);
  const auto points = farthest_points(mesh.graph, mesh.positions, 20, 1);
  const double covered = radius(distances, points);
  for (const auto a : points)
    for (const auto b : points) {
      if (a == b) continue;
      EXPECT_GE(distances[a][b] * (1 + 1e-12), covered);
    }
}

TEST(Farthest_points, reach_every_component_first_and_vertices_without_edges_last) {
  const auto surface = scattered_mesh();  // four components, then four isolated vertices
  const Numbered_mesh mesh(surface);
  const std::uint32_t with_edges = mesh.numbering.vertex_count() - 4;
  const auto component = [](std::uint32_t v) { return v < 38 ? 0 : v < 58 ? 1 : v < 78 ? 2 : 3; };
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto points = farthest_points(mesh.graph, mesh.positions, with_edges + 4, seed);
    std::set<int> reached;
    for (std::size_t n = 0; n < 4; ++n) reached.insert(component(points[n]));
    EXPECT_EQ(reached.size(), 4U);
    for (std::size_t n = 0; n < points.size(); ++n) EXPECT_EQ(points[n] < with_edges, n < with_edges);
    EXPECT_EQ(std::set<std::uint32_t>(points.begin(), points.end()).size(), points.size());
  }
}

TEST(Farthest_point, regions_are_the_vertices_nearest_to_the_seeds) {
  const auto surface = potato(6);
  const Numbered_mesh mesh(surface);
  const auto labels = labels_of(Farthest_point{.options = {.seed = 2}}, surface, 12);
  const auto seeds = farthest_points(mesh.graph, mesh.positions, 12, 2);
  const auto nearest = plain_distances_to_nearest(mesh.graph, mesh.positions, seeds);
  for (std::size_t v = 0; v < labels.size(); ++v)
    EXPECT_EQ(plain_distances(mesh.graph, mesh.positions, seeds[labels[v]])[v], nearest[v]) << v;
}

TEST(Farthest_point, is_in_the_registry) { expect_in_registry(Farthest_point{.options = {.seed = 3}}, {.seed = 3}); }

TEST(Farthest_point, divides_awkward_meshes) {
  expect_sound_on_awkward_meshes(Farthest_point{}, always_as_wanted);
  expect_invariant_under_translation_and_scale(Farthest_point{});
}

}  // namespace
}  // namespace lodestone
