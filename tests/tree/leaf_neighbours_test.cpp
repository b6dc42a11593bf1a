// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/leaf_neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "particles/owned_surface.h"

namespace lodestone {
namespace {

bool share_an_edge(const Corners& f, const Corners& g) {
  return std::ranges::count_if(f, [&](auto corner) { return std::ranges::find(g, corner) != g.end(); }) >= 2;
}

/// Compares with all faces. The edges are those that particles walk along.
void expect_neighbours(const Owned_surface& surface, std::size_t leaf_faces) {
  const auto& soup = surface.soup();
  const Tree_layout layout(soup.faces, octants(soup), soup.coordinates, {.leaf_faces = leaf_faces});
  const Leaf_neighbours neighbours(layout, surface.walked(), soup.vertex_count());
  std::vector<std::uint32_t> leaf_of(soup.faces.size());
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    for (const auto face : layout.faces(leaf)) leaf_of[face] = leaf;
  for (std::uint32_t face = 0; face < soup.faces.size(); ++face) {
    EXPECT_EQ(neighbours.leaf_of(face), leaf_of[face]);
    std::set<std::uint32_t> expected{12345};
    for (std::uint32_t other = 0; other < soup.faces.size(); ++other)
      if (leaf_of[other] != leaf_of[face] && share_an_edge(surface.walked()[face], surface.walked()[other]))
        expected.insert(leaf_of[other]);
    std::vector<std::uint32_t> beside{12345};
    neighbours.list_beside(surface.walked(), *surface.view().vertex_faces, face, beside);
    EXPECT_EQ(beside.front(), 12345U) << "what was listed before must stay";
    EXPECT_EQ(std::set(beside.begin(), beside.end()), expected);
  }
}

TEST(Leaf_neighbours, are_those_across_the_edges_of_faces) {
  for (const auto& [name, soup] : small_objects())
    for (const std::size_t leaf_faces : {4, 16, 96}) {
      SCOPED_TRACE(name);
      expect_neighbours(Owned_surface(soup), leaf_faces);
    }
}

TEST(Leaf_neighbours, lie_beyond_seams_that_are_closed) {
  const Face_soup soup = flat_shaded(sphere(8));
  expect_neighbours(Owned_surface(soup, true), 8);
  expect_neighbours(Owned_surface(soup), 8);
}

}  // namespace
}  // namespace lodestone
