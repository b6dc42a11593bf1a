// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/centroidal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lodestone/partition/farthest_point.h"
#include "partition/geodesic_oracle.h"
#include "partition/strategy_cases.h"

namespace lodestone {
namespace {

constexpr std::array starts{Centroidal_start::farthest_points, Centroidal_start::random_vertices};

Numbered_surface surface_of(const Numbered_mesh& mesh) { return {mesh.graph, mesh.positions, mesh.faces}; }

/// Areas of the vertices by Heron's formula.
std::vector<double> areas_of(const Numbered_mesh& mesh) {
  std::vector<double> areas(mesh.numbering.vertex_count(), 0);
  for (const auto& [a, b, c] : mesh.faces) {
    const double x = (mesh.positions.row(b) - mesh.positions.row(c)).norm();
    const double y = (mesh.positions.row(c) - mesh.positions.row(a)).norm();
    const double z = (mesh.positions.row(a) - mesh.positions.row(b)).norm();
    const double s = (x + y + z) / 2;
    for (const auto corner : {a, b, c}) areas[corner] += std::sqrt(s * (s - x) * (s - y) * (s - z)) / 3;
  }
  return areas;
}

double energy_of(const Numbered_mesh& mesh, const std::vector<std::uint32_t>& seeds) {
  const auto areas = areas_of(mesh);
  const auto distances = plain_distances_to_nearest(mesh.graph, mesh.positions, seeds);
  double sum = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) sum += areas[v] * distances[v] * distances[v];
  return sum;
}

TEST(Centroidal_seeds, energy_follows_its_definition_and_does_not_exceed_its_start) {
  const Numbered_mesh mesh(potato(7));
  for (const auto start : starts)
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const auto seeds = centroidal_seeds(surface_of(mesh), 10, {.seed = seed, .start = start});
      const double least = *std::ranges::min_element(seeds.energies);
      EXPECT_NEAR(energy_of(mesh, seeds.vertices), least, 1e-9 * least);
      EXPECT_LT(least, seeds.energies.front());
    }
}

TEST(Centroidal_seeds, energy_starts_at_that_of_the_farthest_points) {
  const Numbered_mesh mesh(potato(5));
  const auto start = farthest_points(mesh.graph, mesh.positions, 6, 4);
  const auto seeds = centroidal_seeds(surface_of(mesh), 6, {.seed = 4});
  EXPECT_NEAR(energy_of(mesh, start), seeds.energies.front(), 1e-9 * seeds.energies.front());
}

TEST(Centroidal_seeds, after_convergence_are_the_vertices_nearest_to_the_centroids_of_their_cells) {
  const auto surface = potato(7);
  const Numbered_mesh mesh(surface);
  const auto areas = areas_of(mesh);
  std::size_t settled = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Centroidal_options options{.seed = seed, .start = Centroidal_start::random_vertices};
    const auto seeds = centroidal_seeds(surface_of(mesh), 8, options);
    // The returned seeds are those at convergence only if the energy never rose.
    if (!seeds.settled || !std::ranges::is_sorted(seeds.energies, std::greater())) continue;
    ++settled;
    const auto labels = labels_of(Centroidal{.options = options}, surface, 8);
    for (Region_index cell = 0; cell < 8; ++cell) {
      EXPECT_EQ(labels[seeds.vertices[cell]], cell);
      Eigen::RowVector3d centroid = Eigen::RowVector3d::Zero();
      double area = 0;
      for (std::uint32_t v = 0; v < labels.size(); ++v)
        if (labels[v] == cell) {
          centroid += areas[v] * mesh.positions.row(v);
          area += areas[v];
        }
      centroid /= area;
      const double reached = (mesh.positions.row(seeds.vertices[cell]) - centroid).norm();
      for (std::uint32_t v = 0; v < labels.size(); ++v) {
        if (labels[v] != cell) continue;
        EXPECT_LE(reached, (mesh.positions.row(v) - centroid).norm() + 1e-12);
      }
    }
  }
  EXPECT_GE(settled, 3U);
}

TEST(Centroidal_seeds, divide_a_strip_into_equal_pieces) {
  // Along a strip 60 long, three settled cells of centroids c and borders halfway between them are 20 long each; every
  // border may stop a square or so early, where no vertex is nearer to a centroid than the seed is.
  const auto surface = grid(61, 2);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto labels = labels_of(Centroidal{.options = {.seed = seed}}, surface, 3);
    for (const auto size : sizes_of(labels)) EXPECT_NEAR(static_cast<double>(size), 122.0 / 3, 8);
  }
}

TEST(Centroidal_seeds, weigh_vertices_by_area) {
  // One region of a strip whose left half is ten times as fine: the middle of the area, not of the vertices.
  auto surface = grid(221, 2);
  deform(surface, [](const Point& p) { return Point(p.x() <= 200 ? p.x() / 10 : p.x() - 180, p.y(), 0); });
  const Numbered_mesh mesh(surface);
  const auto seeds = centroidal_seeds(surface_of(mesh), 1);
  EXPECT_TRUE(seeds.settled);
  EXPECT_NEAR(mesh.positions(seeds.vertices[0], 0), 20, 0.1);
}

TEST(Centroidal_seeds, use_the_plain_mean_where_there_is_no_area) {
  auto surface = grid(21, 2);
  deform(surface, [](const Point& p) { return Point(p.x(), 0, 0); });
  const Numbered_mesh mesh(surface);
  EXPECT_EQ(mesh.positions(centroidal_seeds(surface_of(mesh), 1).vertices[0], 0), 10);
}

TEST(Centroidal_seeds, iterations_are_limited) {
  const Numbered_mesh mesh(potato(7));
  const auto seeds =
      centroidal_seeds(surface_of(mesh), 10, {.start = Centroidal_start::random_vertices, .max_iterations = 2});
  EXPECT_EQ(seeds.energies.size(), 3U);
  EXPECT_FALSE(seeds.settled);
  EXPECT_THROW(centroidal_seeds(surface_of(mesh), 10, {.max_iterations = 0}), Bad_argument);
}

TEST(Centroidal, depends_on_the_seed) {
  const auto mesh = potato(6);
  for (const auto start : starts) {
    std::set<std::vector<Region_index>> different_labels;
    for (std::uint64_t seed = 0; seed < 10; ++seed)
      different_labels.insert(labels_of(Centroidal{.options = {.seed = seed, .start = start}}, mesh, 8));
    EXPECT_GE(different_labels.size(), 5U);  // different starts may converge to the same seeds
  }
}

TEST(Centroidal, is_in_the_registry) { expect_in_registry(Centroidal{.options = {.seed = 3}}, {.seed = 3}); }

TEST(Centroidal, divides_awkward_meshes) {
  for (const auto start : starts) {
    expect_sound_on_awkward_meshes(Centroidal{.options = {.start = start}}, always_as_wanted);
    expect_invariant_under_translation_and_scale(Centroidal{.options = {.start = start}});
  }
}

}  // namespace
}  // namespace lodestone
