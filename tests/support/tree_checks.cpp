// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/tree_checks.h"

namespace lodestone {

std::vector<Tree_case> tree_cases() {
  const Face_soup triangle(single_triangle());
  Face_soup point = lattice_soup(300, 90, 1, 1), line = lattice_soup(300, 90, 9, 2), copies;
  for (std::size_t i = 0; i < line.coordinates.size(); ++i)
    if (i % 3 != 0) line.coordinates[i] = 0;
  for (int i = 0; i < 200; ++i) copies = joined(copies, triangle);
  Face_soup same_face = triangle;
  same_face.faces.resize(500, same_face.faces[0]);
  Face_soup unused = triangle;
  unused.coordinates.resize(39, 7.0);
  return {{"one triangle", triangle},
          {"two triangles", joined(triangle, placed(triangle, 1, 5))},
          {"closed", icosphere(6)},
          {"open", cloth(31, 17)},
          {"several components", joined(joined(icosphere(3), placed(icosphere(5), 0.1, 4)), cloth(9, 9))},
          {"shuffled", shuffled(Face_soup(icosphere(6)), 1)},
          {"any faces", lattice_soup(700, 100, 5, 3)},
          {"faces without area on a line", line},
          {"all in one point", point},
          {"vertices many times in one place", copies},
          {"one face many times", same_face},
          {"unused vertices", unused}};
}

Aabb box_around(std::span<const std::uint32_t> vertices, Coordinates coordinates) {
  constexpr double most = std::numeric_limits<double>::max();
  Aabb box{.low = {most, most, most}, .high = {-most, -most, -most}};
  for (const std::size_t v : vertices)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], coordinates[3 * v + axis]);
      box.high[axis] = std::max(box.high[axis], coordinates[3 * v + axis]);
    }
  return box;
}

void expect_equal(const Aabb& a, const Aabb& b) {
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(a.low[axis], b.low[axis]);
    ASSERT_EQ(a.high[axis], b.high[axis]);
  }
}

void expect_equal_boxes(const Region_tree& a, const Region_tree& b) {
  ASSERT_EQ(a.node_count(), b.node_count());
  for (std::uint32_t n = 0; n < a.node_count(); ++n) expect_equal(a.volume(n), b.volume(n));
  EXPECT_EQ(a.looseness(), b.looseness());
}

void expect_tree(const Region_tree& tree, const Face_soup& soup, Coordinates coordinates) {
  EXPECT_EQ(tree.validate(soup.faces, coordinates), "");
  std::vector<int> times(soup.faces.size(), 0);
  for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const auto faces = tree.faces(leaf), vertices = tree.vertices(leaf);
    std::set<std::uint32_t> used;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      ++times.at(faces[i]);
      for (int corner = 0; corner < 3; ++corner)
        ASSERT_EQ(vertices[tree.corners(leaf)[i][corner]], soup.faces[faces[i]][corner]);
      used.insert(soup.faces[faces[i]].begin(), soup.faces[faces[i]].end());
    }
    ASSERT_TRUE(std::ranges::equal(used, vertices)) << "ascending, each once";
    ASSERT_TRUE(tree.is_leaf(tree.leaf_node(leaf)));
    ASSERT_EQ(tree.node(tree.leaf_node(leaf)).leaf, leaf);
    expect_equal(tree.volume(tree.leaf_node(leaf)), box_around(vertices, coordinates));
  }
  EXPECT_TRUE(std::ranges::all_of(times, [](int n) { return n == 1; })) << "each face in one leaf";

  EXPECT_EQ(tree.node_count(), 2 * tree.leaf_count() - 1);
  for (std::uint32_t n = 0; n < tree.node_count(); ++n) {
    if (tree.is_leaf(n)) continue;
    const Aabb &first = tree.volume(n + 1), &second = tree.volume(tree.node(n).second_child);
    Aabb both = first;
    for (int axis = 0; axis < 3; ++axis) {
      both.low[axis] = std::min(both.low[axis], second.low[axis]);
      both.high[axis] = std::max(both.high[axis], second.high[axis]);
    }
    expect_equal(tree.volume(n), both);
  }
}

}  // namespace lodestone
