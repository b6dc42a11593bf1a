// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/oriented_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "partition/surface_soup.h"

namespace lodestone {
namespace {

Oriented_mesh oriented(const Surface_soup& soup) { return oriented_mesh(soup.surface()); }

/// The sorted corners of every face, as the mesh has them.
void expect_same_faces(const Surface_soup& soup, const Oriented_mesh& oriented,
                       const std::vector<std::uint32_t>& kept) {
  ASSERT_TRUE(oriented.mesh.is_valid(false));
  ASSERT_EQ(oriented.mesh.number_of_vertices(), oriented.vertex_indices.size());
  ASSERT_EQ(oriented.face_indices, kept);
  for (const auto f : oriented.mesh.faces()) {
    Corners expected = soup.faces[oriented.face_indices[f]], corners{};
    std::size_t i = 0;
    const auto follows = [](const Corners& face, std::uint32_t a, std::uint32_t b) {
      return (face[0] == a && face[1] == b) || (face[1] == a && face[2] == b) || (face[2] == a && face[0] == b);
    };
    for (const auto v : oriented.mesh.vertices_around_face(oriented.mesh.halfedge(f)))
      corners.at(i++) = oriented.vertex_indices[v];
    EXPECT_EQ(follows(expected, corners[0], corners[1]), !oriented.turned[f]);
    std::ranges::sort(corners);
    std::ranges::sort(expected);
    EXPECT_EQ(corners, expected);
  }
}

TEST(Oriented_mesh, a_manifold_oriented_mesh_is_unchanged) {
  for (const auto& mesh : {potato(4), grid(4, 3), single_triangle(), cube(2)}) {
    const auto soup = surface_soup(mesh);
    const auto result = oriented(soup);
    ASSERT_EQ(result.mesh.number_of_faces(), mesh.number_of_faces());
    for (const auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f), same = result.mesh.halfedge(f);
      EXPECT_EQ(mesh.target(mesh.next(h)), result.mesh.target(result.mesh.next(same)));
      EXPECT_EQ(mesh.target(h), result.mesh.target(same));
    }
    EXPECT_EQ(result.mesh.number_of_vertices(), mesh.number_of_vertices());
  }
}

TEST(Oriented_mesh, an_edge_of_three_faces_is_cut_open) {
  const Surface_soup soup{Positions::Random(5, 3), {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  expect_same_faces(soup, oriented(soup), {0, 1, 2});
}

TEST(Oriented_mesh, two_fans_at_a_vertex_get_a_vertex_each) {
  const Surface_soup soup{Positions::Random(5, 3), {{0, 1, 2}, {0, 3, 4}}};
  const auto result = oriented(soup);
  EXPECT_EQ(result.vertex_indices.size(), 6U);
  expect_same_faces(soup, result, {0, 1});
}

TEST(Oriented_mesh, faces_are_reversed_where_neighbours_disagree) {
  const Surface_soup soup{Positions::Random(4, 3), {{0, 1, 2}, {0, 1, 3}}};
  const auto result = oriented(soup);
  EXPECT_EQ(result.vertex_indices.size(), 4U);  // one sheet, nothing cut
  expect_same_faces(soup, result, {0, 1});
  EXPECT_NE(result.turned[0], result.turned[1]);
}

TEST(Oriented_mesh, a_face_with_a_repeated_corner_is_dropped) {
  const Surface_soup soup{Positions::Random(5, 3), {{0, 0, 1}, {1, 2, 3}, {4, 4, 4}}};
  expect_same_faces(soup, oriented(soup), {1});
  const Surface_soup nothing{Positions::Random(2, 3), {{0, 0, 1}}};
  expect_same_faces(nothing, oriented(nothing), {});
}

TEST(Oriented_mesh, one_face_three_times_is_three_faces) {
  const Surface_soup soup{Positions::Random(3, 3), {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}}};
  expect_same_faces(soup, oriented(soup), {0, 1, 2});
}

TEST(Oriented_mesh, coordinates_of_any_magnitude_are_scaled_to_minus_1_to_1) {
  for (const double size : {1e-300, 1.0, 1e300}) {
    auto mesh = potato(3);
    scale(mesh, size);
    double largest = 0;
    const auto result = oriented(surface_soup(mesh));
    for (const auto v : result.mesh.vertices())
      for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(result.mesh.point(v)[i]));
    EXPECT_LE(largest, 1);
    EXPECT_GE(largest, 0.5);
  }
}

}  // namespace
}  // namespace lodestone
