// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/leaf_neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "support/owned_surface.h"

namespace lodestone {
namespace {

bool share_an_edge(const Corners& f, const Corners& g) {
  return std::ranges::count_if(f, [&](auto corner) { return std::ranges::find(g, corner) != g.end(); }) >= 2;
}

Leaf_neighbours neighbours_in(const Tree_layout& layout, const Owned_surface& surface) {
  Leaf_neighbours neighbours(layout, surface.soup().faces.size());
  neighbours.look_at(layout, surface.walked(), *surface.view().vertex_faces);
  return neighbours;
}

/// Compares with all faces. The edges are those that particles walk along.
void expect_neighbours(const Owned_surface& surface, std::size_t leaf_faces) {
  const auto& soup = surface.soup();
  const Tree_layout layout(soup.faces, octants(soup), soup.coordinates, {.leaf_faces = leaf_faces});
  Leaf_neighbours neighbours = neighbours_in(layout, surface);
  std::vector<std::uint32_t> leaf_of(soup.faces.size());
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    for (const auto face : layout.faces(leaf)) leaf_of[face] = leaf;
  for (std::uint32_t face = 0; face < soup.faces.size(); ++face) {
    EXPECT_EQ(neighbours.leaf_of(face), leaf_of[face]);
    std::set<std::uint32_t> expected;
    for (std::uint32_t other = 0; other < soup.faces.size(); ++other)
      if (leaf_of[other] != leaf_of[face] && share_an_edge(surface.walked()[face], surface.walked()[other]))
        expected.insert(leaf_of[other]);
    const auto beside = neighbours.beside(face);
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

TEST(Leaf_neighbours, are_found_at_vertices_with_very_many_faces) {
  constexpr std::uint32_t vertices = 60;
  std::mt19937_64 random(1);
  Face_soup soup;
  for (std::uint32_t i = 0; i < 3 * vertices; ++i) soup.coordinates.push_back(std::cos(7.0 * i));
  while (soup.faces.size() < 1500) {
    const auto corner = [&] { return static_cast<std::uint32_t>(random() % vertices); };
    const std::uint32_t a = corner(), b = corner(), c = corner();
    if (a != b && b != c && c != a) soup.faces.push_back({a, b, c});
  }
  expect_neighbours(Owned_surface(soup), 40);
}

/// Pages that are bound along one edge, each a strip of faces away from it.
Face_soup book(std::uint32_t pages, std::uint32_t strips) {
  Face_soup soup;
  soup.coordinates = {0, 0, 0, 0, 0, 1};
  for (std::uint32_t page = 0; page < pages; ++page) {
    const double angle = 6 * static_cast<double>(page) / pages;
    std::uint32_t low = 0, high = 1;
    for (std::uint32_t strip = 1; strip <= strips; ++strip) {
      const auto next = static_cast<std::uint32_t>(soup.vertex_count());
      for (const double z : {0.0, 1.0})
        for (const double coordinate : {strip * std::cos(angle), strip * std::sin(angle), z})
          soup.coordinates.push_back(coordinate);
      soup.faces.push_back({low, high, next});
      soup.faces.push_back({high, next + 1, next});
      low = next, high = next + 1;
    }
  }
  return soup;
}

TEST(Leaf_neighbours, of_an_edge_with_very_many_leaves_are_some_in_a_ring) {
  constexpr std::uint32_t pages = 60, strips = 4;
  const Owned_surface surface(book(pages, strips));
  const auto& soup = surface.soup();
  const std::vector<Region_index> labels(soup.vertex_count());
  const Tree_layout layout(soup.faces, labels, soup.coordinates, {.leaf_faces = 4});
  Leaf_neighbours neighbours = neighbours_in(layout, surface);
  std::map<std::uint32_t, std::set<std::uint32_t>> beside_leaf;
  for (std::uint32_t page = 0; page < pages; ++page) {
    const std::uint32_t bound = page * 2 * strips;  // the face at the edge
    auto& leaves = beside_leaf[neighbours.leaf_of(bound)];
    EXPECT_LE(neighbours.beside(bound).size(), Leaf_neighbours::most_per_edge + 2) << "two other edges have two faces";
    for (const auto leaf : neighbours.beside(bound)) leaves.insert(leaf);
  }
  ASSERT_GT(beside_leaf.size(), Leaf_neighbours::most_per_edge + 1) << "more leaves than are listed";
  std::set<std::uint32_t> reached{beside_leaf.begin()->first};
  std::vector<std::uint32_t> waiting(reached.begin(), reached.end());
  while (!waiting.empty()) {
    const std::uint32_t leaf = waiting.back();
    waiting.pop_back();
    for (const auto next : beside_leaf[leaf])
      if (reached.insert(next).second) waiting.push_back(next);
  }
  for (std::uint32_t page = 0; page < pages; ++page)
    EXPECT_TRUE(reached.contains(neighbours.leaf_of(page * 2 * strips))) << "all are reached in the end";
}

}  // namespace
}  // namespace lodestone
