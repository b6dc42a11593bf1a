// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/senin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lodestone/particles/hop_metric.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::vector<std::uint32_t> scatter(const Surface_mesh& mesh, std::size_t particles, const Senin_options& options = {}) {
  const Numbered_mesh numbered(mesh);
  return scatter_particles(numbered.graph, numbered.positions, particles, options);
}

TEST(Scatter_particles, gives_different_vertices) {
  const auto mesh = sphere(6);
  for (const std::size_t count : {1, 10, 100, 146}) {
    const auto at = scatter(mesh, count);
    EXPECT_EQ(std::set(at.begin(), at.end()).size(), count);
    for (const auto v : at) EXPECT_LT(v, num_vertices(mesh));
  }
}

TEST(Scatter_particles, gives_no_more_than_there_are_vertices_with_edges) {
  auto mesh = sphere(2);
  const std::size_t with_edges = num_vertices(mesh);
  for (int i = 0; i < 30; ++i) mesh.add_vertex({0, 0, 0});
  const auto at = scatter(mesh, 1000);
  EXPECT_EQ(at.size(), with_edges);
  for (const auto v : at) EXPECT_LT(v, with_edges);
}

TEST(Scatter_particles, is_the_same_for_the_same_seed_and_another_for_another) {
  const auto mesh = sphere(6);
  EXPECT_EQ(scatter(mesh, 20, {.seed = 5}), scatter(mesh, 20, {.seed = 5}));
  EXPECT_NE(scatter(mesh, 20, {.seed = 5}), scatter(mesh, 20, {.seed = 6}));
}

TEST(Scatter_particles, covers_the_surface) {
  // Of 20 draws of 12 from a sphere, each octant holds 30 on average.
  const auto mesh = sphere(8);
  std::array<int, 8> octants{};
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const auto v : scatter(mesh, 12, {.seed = seed})) {
      const auto& p = mesh.point(Surface_mesh::Vertex_index(v));
      ++octants[(p.x() > 0 ? 1 : 0) + (p.y() > 0 ? 2 : 0) + (p.z() > 0 ? 4 : 0)];
    }
  for (const int count : octants) EXPECT_GT(count, 8);
}

TEST(Scatter_particles, with_a_side_stays_on_it) {
  const auto mesh = sphere(8, 2, {10, 20, 30});
  const Eigen::Vector3d side(0, -3, 0);
  std::size_t on_side = 0;
  for (const auto& p : mesh.points()) on_side += p.y() - 20 < -1 ? 1 : 0;
  const auto at = scatter(mesh, 100000, {.side = side});
  EXPECT_GE(at.size(), on_side);
  for (const auto v : at) EXPECT_LE(mesh.point(Surface_mesh::Vertex_index(v)).y() - 20, -1 + 1e-9);
}

TEST(Scatter_particles, with_a_side_does_not_heed_vertices_without_edges) {
  auto mesh = sphere(8);
  const auto expected = scatter(mesh, 30, {.side = Eigen::Vector3d(1, 0, 0)});
  EXPECT_EQ(expected.size(), 30U);
  for (int i = 0; i < 30; ++i) mesh.add_vertex({100, 0, 0});
  EXPECT_EQ(scatter(mesh, 30, {.side = Eigen::Vector3d(1, 0, 0)}), expected);
}

TEST(Scatter_particles, with_a_side_finds_a_place_on_a_surface_across_it) {
  for (const int size : {3, 4})
    for (const double direction : {-1.0, 1.0}) {
      Surface_mesh mesh = grid(size, size);
      deform(mesh, [](const Point& p) { return Point(0.1, p.x(), p.y()); });
      EXPECT_EQ(scatter(mesh, 5, {.side = Eigen::Vector3d(direction, 0, 0)}).size(), 5U);
    }
}

TEST(Default_rings, contain_as_many_vertices_as_a_region) {
  // 7, 19, 37 and 61 vertices lie within 1, 2, 3 and 4 hops on a surface of degree 6.
  EXPECT_EQ(default_rings(700, 100), 1U);
  EXPECT_EQ(default_rings(1900, 100), 2U);
  EXPECT_EQ(default_rings(3700, 100), 3U);
  EXPECT_EQ(default_rings(610, 10), 4U);
  EXPECT_EQ(default_rings(620, 10), 5U);
  EXPECT_EQ(default_rings(800, 100), 2U);
  for (const std::size_t vertices : {0, 1, 12, 13, 84}) EXPECT_EQ(default_rings(vertices, 12), 1U);
  EXPECT_EQ(default_rings(0, 0), 1U);
}

TEST(Vertex_faces, are_the_faces_with_that_corner) {
  const auto faces = grid_faces(4, 4);
  const Vertex_faces vertex_faces(16, faces);
  for (std::uint32_t v = 0; v < 16; ++v) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t face = 0; face < faces.size(); ++face)
      if (std::ranges::count(faces[face], v) > 0) expected.push_back(face);
    const auto at = vertex_faces.at(v);
    EXPECT_EQ(std::vector(at.begin(), at.end()), expected);
  }
}

TEST(Ring_patch, contains_the_faces_within_the_given_hops) {
  const Numbered_mesh mesh(potato(6));
  const Vertex_faces vertex_faces(mesh.numbering.vertex_count(), mesh.faces);
  for (const std::uint32_t centre : {0U, 33U, 100U}) {
    const auto hops = breadth_first_hops(mesh.graph, centre);
    for (const std::size_t rings : {0, 1, 2, 5}) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
        if (std::ranges::any_of(mesh.faces[face], [&](auto corner) { return hops[corner] <= rings; }))
          expected.push_back(face);
      EXPECT_EQ(ring_patch(mesh.graph, vertex_faces, mesh.faces, centre, rings).faces, expected);
    }
  }
}

}  // namespace
}  // namespace lodestone
