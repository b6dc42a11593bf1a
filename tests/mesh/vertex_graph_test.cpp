// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/vertex_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::vector<std::uint32_t> list(const Vertex_graph& graph, std::uint32_t vertex) {
  const auto range = neighbours(graph, vertex);
  return {range.begin(), range.end()};
}

TEST(Vertex_graph, neighbours_are_those_that_share_an_edge_each_once_and_ascending) {
  const Numbered_mesh mesh(potato(4));
  std::vector<std::set<std::uint32_t>> expected(mesh.numbering.vertex_count());
  for (const auto& face : mesh.faces)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (i != j) expected[face[i]].insert(face[j]);
  for (std::uint32_t v = 0; v < expected.size(); ++v)
    EXPECT_EQ(list(mesh.graph, v), std::vector(expected[v].begin(), expected[v].end()));
}

TEST(Vertex_graph, the_centre_of_a_grid_has_its_six_neighbours) {
  const auto faces = grid_faces(3, 3);
  EXPECT_EQ(list(vertex_graph(9, faces), 4), (std::vector<std::uint32_t>{0, 1, 3, 5, 7, 8}));
}

TEST(Vertex_graph, a_vertex_without_faces_has_no_neighbours) {
  const std::vector<Corners> faces{{0, 1, 3}};
  const auto graph = vertex_graph(5, faces);
  EXPECT_EQ(num_vertices(graph), 5U);
  EXPECT_TRUE(list(graph, 2).empty());
  EXPECT_TRUE(list(graph, 4).empty());
}

TEST(Vertex_graph, an_edge_of_three_faces_counts_once) {
  const std::vector<Corners> faces{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_EQ(list(vertex_graph(5, faces), 0), (std::vector<std::uint32_t>{1, 2, 3, 4}));
}

TEST(Surface_edges, of_any_faces_are_those_that_a_count_of_all_sides_finds) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    // Few vertices, so that faces have corners twice, edges have many faces, and faces are repeated.
    const auto vertices = static_cast<std::uint32_t>(1 + random() % 9);
    std::vector<Corners> faces(random() % 12);
    for (auto& face : faces)
      for (auto& corner : face) corner = static_cast<std::uint32_t>(random() % vertices);

    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& [a, b, c] : faces)
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if (from != to) ++sides[{from, to}], ++sides[{to, from}];
    std::vector<std::vector<std::uint32_t>> expected(vertices);
    std::vector<bool> open(vertices, false);
    for (const auto& [side, count] : sides) {
      expected[side.first].push_back(side.second);
      if (count == 1) open[side.first] = true;
    }

    const auto edges = surface_edges(Vertex_faces(vertices, faces), faces);
    EXPECT_EQ(edges.open_border, open);
    ASSERT_EQ(num_vertices(edges.graph), vertices);
    EXPECT_EQ(num_edges(edges.graph), sides.size());
    for (std::uint32_t v = 0; v < vertices; ++v) EXPECT_EQ(list(edges.graph, v), expected[v]);
  }
}

TEST(Open_border, of_a_grid_is_its_outline) {
  const auto faces = grid_faces(5, 4);
  const auto border = open_border(20, faces);
  for (std::uint32_t v = 0; v < 20; ++v) {
    const auto x = v % 5, y = v / 5;
    EXPECT_EQ(border[v], x == 0 || x == 4 || y == 0 || y == 3) << v;
  }
}

TEST(Open_border, of_a_closed_surface_is_empty) {
  const Numbered_mesh mesh(tetrahedron());
  const auto border = open_border(4, mesh.faces);
  EXPECT_EQ(std::ranges::count(border, true), 0);
}

TEST(Open_border, an_edge_of_three_faces_is_not_open) {
  // Three triangles around the edge 0 1: the other edges are open, and touch both of its ends.
  const std::vector<Corners> fan{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_EQ(open_border(5, fan), std::vector<bool>(5, true));
  // A tetrahedron with a fin within: the edges 0 4 and 4 1 of the fin are the only open ones.
  const std::vector<Corners> fin{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 4}};
  EXPECT_EQ(open_border(5, fin), (std::vector<bool>{true, true, false, false, true}));
}

}  // namespace
}  // namespace lodestone
