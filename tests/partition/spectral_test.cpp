// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/spectral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "partition/lathe.h"
#include "partition/partition_checks.h"
#include "partition/surface_soup.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// A path of vertices without faces.
Vertex_graph path(std::uint32_t size) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t v = 0; v < size; ++v) {
    if (v > 0) edges.emplace_back(v, v - 1);
    if (v + 1 < size) edges.emplace_back(v, v + 1);
  }
  return {boost::edges_are_sorted, edges.begin(), edges.end(), size};
}

TEST(Spectral, every_surface_gets_exactly_the_requested_regions) { expect_exact_counts(Spectral{}); }

TEST(Spectral, odd_surfaces_are_labelled) { expect_odd_surfaces_labelled(Spectral{}); }

TEST(Spectral, the_fiedler_vector_of_a_path_is_a_cosine) {
  // Eigenvalue 2 - 2 cos(pi / n), vector -cos(pi (i + 1/2) / n); dense below 48 vertices, sparse above.
  for (const std::uint32_t n : {2, 3, 10, 48, 49, 500, 5000}) {
    const auto fiedler = fiedler_vector(path(n), {.tolerance = 1e-9});
    const double angle = std::numbers::pi / n;
    EXPECT_NEAR(fiedler.eigenvalue / (2 - 2 * std::cos(angle)), 1, 1e-6) << n;
    const double scale = fiedler.values.norm() / std::sqrt(n / 2.0);
    for (std::uint32_t i = 0; i < n; ++i)
      EXPECT_NEAR(fiedler.values[i] / scale, -std::cos(angle * (i + 0.5)), 1e-5) << n << " " << i;
  }
}

TEST(Spectral, the_normalised_laplacian_of_a_path_gives_its_known_cosine) {
  // The random walk on a path: eigenvalue 1 - cos(pi / (n - 1)), vector -cos(pi i / (n - 1)).
  for (const std::uint32_t n : {3, 30, 300}) {
    const auto fiedler = fiedler_vector(path(n), {.laplacian = Laplacian::normalised, .tolerance = 1e-9});
    const double angle = std::numbers::pi / (n - 1);
    EXPECT_NEAR(fiedler.eigenvalue / (1 - std::cos(angle)), 1, 1e-6) << n;
    for (std::uint32_t i = 0; i < n; ++i)
      EXPECT_NEAR(fiedler.values[i] / -fiedler.values[0], -std::cos(angle * i), 1e-5) << n << " " << i;
  }
}

TEST(Spectral, a_strip_is_cut_in_the_middle) {
  for (const auto laplacian : {Laplacian::combinatorial, Laplacian::normalised}) {
    const auto labels = labels_of(Spectral{.options = {.laplacian = laplacian}}, grid(40, 3), 2);
    for (std::uint32_t v = 0; v < 120; ++v) {
      if (v % 40 == 19 || v % 40 == 20) continue;  // diagonals lean to one side
      EXPECT_EQ(labels[v], v % 40 < 20 ? 0U : 1U) << v;
    }
    EXPECT_EQ(std::ranges::count(labels, 0U), 60);
  }
}

TEST(Spectral, the_bridge_between_two_balls_is_cut) {
  const auto mesh = dumbbell(1, 1, 0.1);
  const auto labels = labels_of(Spectral{}, mesh, 2);
  for (const auto v : mesh.vertices()) {
    if (std::abs(mesh.point(v).x()) < 0.5) continue;
    EXPECT_EQ(labels[v] == labels[0], mesh.point(v).x() < 0);
  }
}

TEST(Spectral, between_unequal_balls_the_zero_cut_finds_the_bridge_and_the_median_does_not) {
  const auto big = sphere(14, 1, {-1, 0, 0}), small = sphere(7, 0.4, {0.4, 0, 0});
  // Joined by two faces between the vertices that are nearest to each other.
  std::vector<Point> points;
  std::vector<Corners> faces;
  for (const auto* ball : {&big, &small}) {
    const auto first = static_cast<std::uint32_t>(points.size());
    const Numbered_mesh numbered(*ball);
    for (const auto v : ball->vertices()) points.push_back(ball->point(v));
    for (const auto& [a, b, c] : numbered.faces) faces.push_back({first + a, first + b, first + c});
  }
  const auto count = static_cast<std::uint32_t>(big.number_of_vertices());
  faces.push_back({0, count, count + 1});
  Positions positions(points.size(), 3);
  for (std::size_t v = 0; v < points.size(); ++v) positions.row(v) << points[v].x(), points[v].y(), points[v].z();
  const Surface_soup soup{positions, faces};
  const auto labels = Spectral{.options = {.cut = Spectral_cut::zero}}.label(soup.surface(), 2).labels;
  // Zero is slightly inside the larger ball, near the bridge.
  std::uint32_t strays = 0;
  for (std::uint32_t v = 0; v < labels.size(); ++v) strays += (labels[v] == labels[count]) == (v < count) ? 1 : 0;
  EXPECT_LT(strays, count / 50);
  const auto halves = Spectral{}.label(soup.surface(), 2).labels;
  EXPECT_EQ(std::ranges::count(halves, 0U), static_cast<std::ptrdiff_t>(labels.size() + 1) / 2);
}

TEST(Spectral, halves_of_halves_are_of_equal_size) {
  const auto sizes = label_sizes(Spectral{}, potato(16), 16);
  const auto [least, most] = std::ranges::minmax(sizes);
  EXPECT_LE(most - least, 1U);
}

TEST(Spectral, components_are_separated_before_any_is_cut) {
  Surface_mesh mesh;
  for (int i = 0; i < 4; ++i) append(mesh, sphere(3 + i, 0.3, {1.0 * i, 0, 0}));
  const auto labels = labels_of(Spectral{}, mesh, 4);
  std::size_t first = 0;
  for (int i = 0; i < 4; ++i) {
    const std::size_t size = 4 * (3 + i) * (3 + i) + 2;
    for (std::size_t v = first; v < first + size; ++v) EXPECT_EQ(labels[v], labels[first]);
    first += size;
  }
  EXPECT_EQ(label_sizes(Spectral{}, mesh, 4).size(), 4U);
}

TEST(Spectral, the_seed_decides_only_where_eigenvalues_are_equal) {
  const auto with_seed = [](const Surface_mesh& mesh, std::uint64_t seed) {
    return labels_of(Spectral{.options = {.seed = seed}}, mesh, 2);
  };
  EXPECT_EQ(with_seed(grid(60, 5), 1), with_seed(grid(60, 5), 2));
  // This sphere has the symmetry of an octahedron, so three eigenvalues are equal: one for each axis.
  EXPECT_EQ(with_seed(sphere(10), 3), with_seed(sphere(10), 3));
  std::set<std::vector<Region_index>> halvings;
  for (const std::uint64_t seed : {1, 2, 3, 4}) halvings.insert(with_seed(sphere(10), seed));
  EXPECT_GT(halvings.size(), 1U);
}

TEST(Spectral, too_many_vertices_and_options_out_of_range_are_refused) {
  const auto with = [](const Spectral_options& options) { labels_of(Spectral{.options = options}, tetrahedron(), 2); };
  for (const double tolerance : {0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(with({.tolerance = tolerance}), Bad_argument);
  EXPECT_THROW(with({.max_iterations = 0}), Bad_argument);
  EXPECT_THROW(labels_of(Spectral{}, tetrahedron(), 0), Bad_argument);
  EXPECT_THROW(fiedler_vector(path(1)), Bad_argument);
  const auto vertices = static_cast<Eigen::Index>(Spectral::most_vertices + 1);
  const Surface_soup large{Positions::Zero(vertices, 3), {{0, 1, 2}}};
  EXPECT_THROW(Spectral{}.label(large.surface(), 2), Bad_argument);
  const Surface_soup largest{Positions::Zero(vertices - 1, 3), {{0, 1, 2}}};
  EXPECT_NO_THROW(Spectral{}.label(largest.surface(), 2));
}

}  // namespace
}  // namespace lodestone
