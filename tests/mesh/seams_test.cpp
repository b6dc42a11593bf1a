// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/seams.h"

#include <gtest/gtest.h>

#include "lodestone/mesh/vertex_graph.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::optional<Closed_seams> closed(const Surface_mesh& mesh) {
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  return close_seams(numbering.corners(), open_border(numbering.vertex_count(), numbering.corners()),
                     read_positions(numbering, mesh.points()));
}

TEST(Seams, of_a_surface_whose_triangles_share_no_vertex_close_to_that_surface) {
  const Surface_mesh whole = sphere(4), apart = flat_shaded(whole);
  ASSERT_EQ(num_vertices(apart), 3 * num_faces(whole));
  const auto seams = closed(apart);
  ASSERT_TRUE(seams);
  EXPECT_EQ(seams->vertices.size(), num_vertices(whole));
  EXPECT_EQ(seams->joined_count(), num_vertices(apart) - num_vertices(whole));
  for (std::uint32_t v = 0; v < num_vertices(apart); ++v)
    EXPECT_EQ(apart.point(Surface_mesh::Vertex_index(v)), apart.point(Surface_mesh::Vertex_index(seams->joined(v))));
  const auto border = open_border(static_cast<std::uint32_t>(seams->vertices.size()), seams->corners);
  EXPECT_EQ(std::ranges::count(border, true), 0);
}

TEST(Seams, a_surface_without_doubled_vertices_has_none) {
  EXPECT_FALSE(closed(sphere(4)));
  EXPECT_FALSE(closed(grid(4, 4)));
}

TEST(Seams, closed_surfaces_that_touch_at_a_vertex_stay_apart) {
  Surface_mesh two = sphere(3);
  append(two, sphere(3, 1, {2, 0, 0}));
  EXPECT_FALSE(closed(two));
}

TEST(Seams, borders_at_one_place_are_joined_and_others_are_not) {
  Surface_mesh two = grid(3, 2);  // x from 0 to 2
  Surface_mesh right = grid(3, 2);
  shift(right, 2);
  append(two, right);
  const auto seams = closed(two);
  ASSERT_TRUE(seams);
  EXPECT_EQ(seams->joined_count(), 2U);
  EXPECT_EQ(seams->index[6], seams->index[2]);
  EXPECT_EQ(seams->index[9], seams->index[5]);
}

TEST(Seams, the_two_zeros_are_the_same_place) {
  const auto mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, -0.0, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  const auto seams = closed(mesh);
  ASSERT_TRUE(seams);
  EXPECT_EQ(seams->joined(3), 0U);
}

TEST(Seams, a_face_keeps_three_corners) {
  // The first face has two corners at the origin, where the second has one.
  for (const Corners& first : {Corners{0, 1, 2}, Corners{1, 2, 0}, Corners{2, 0, 1}}) {
    const auto mesh = mesh_of({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                              {{first[0], first[1], first[2]}, {3, 4, 5}});
    const auto seams = closed(mesh);
    ASSERT_TRUE(seams);
    EXPECT_EQ(seams->joined_count(), 1U);
    EXPECT_EQ(seams->joined(5), 2U);
  }
  const auto all = mesh_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}});
  EXPECT_FALSE(closed(all));
}

TEST(Seams, join_vertices_to_the_lowest_of_them) {
  const std::vector<Corners> faces{{0, 1, 2}, {3, 4, 5}};
  const std::vector<std::uint32_t> lowest{0, 1, 2, 2, 4, 5}, highest{0, 1, 3, 3, 4, 5}, chain{0, 0, 2, 1, 4, 5};
  const auto seams = seams_of(faces, lowest);
  ASSERT_TRUE(seams);
  EXPECT_EQ(seams->joined(3), 2U);
  EXPECT_FALSE(seams_of(faces, highest));
  EXPECT_FALSE(seams_of(faces, chain));
}

}  // namespace
}  // namespace lodestone
