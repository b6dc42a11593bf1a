// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of which some faces change.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "support/tree_checks.h"

namespace lodestone {
namespace {

using Changed = std::vector<std::uint32_t>;

/// Gives some faces corners of their neighbours, removes some from the end, and adds some with a new vertex.
Changed change_some(Face_soup& soup, std::size_t count, std::mt19937_64& random) {
  std::set<std::uint32_t> changed;
  for (std::size_t i = 0; i < count; ++i) {
    const auto face = static_cast<std::uint32_t>(random() % soup.faces.size());
    const auto& other = soup.faces[random() % 2 == 0 ? face / 2 : (face + 1) % soup.faces.size()];
    soup.faces[face][random() % 3] = other[random() % 3];
    changed.insert(face);
  }
  const std::size_t faces_before = soup.faces.size();
  soup.faces.resize(soup.faces.size() - random() % (count + 1));
  for (std::size_t i = random() % (count + 1); i > 0; --i) {
    auto corners = soup.faces[random() % soup.faces.size()];
    const auto near = soup.point(corners[0]);
    corners[1] = soup.vertex_count();
    soup.coordinates.insert(soup.coordinates.end(), {near.x() + 0.01, near.y(), near.z()});
    if (soup.faces.size() < faces_before) changed.insert(static_cast<std::uint32_t>(soup.faces.size()));
    soup.faces.push_back(corners);
  }
  Changed list;
  for (const auto face : changed)
    if (face < soup.faces.size()) list.push_back(face);
  return list;
}

TEST(Tree_mender, a_mended_tree_is_valid_however_often_it_is_mended) {
  std::mt19937_64 random(1);
  for (const std::size_t leaf_faces : {2, 7, 96, 128})
    for (auto soup : {Face_soup(icosphere(20)), shuffled(Face_soup(cloth(60, 70)), 1)}) {
      Region_tree tree(soup.faces, {}, soup.coordinates, {.leaf_faces = leaf_faces});
      int mended = 0;
      for (int round = 0; round < 30; ++round) {
        const auto changed = change_some(soup, round % 10 * 8, random);
        if (tree.mend(soup.faces, changed, soup.coordinates, {.leaf_faces = leaf_faces}))
          ++mended;
        else
          tree = Region_tree(soup.faces, {}, soup.coordinates, {.leaf_faces = leaf_faces});
        expect_tree(tree, soup, soup.coordinates);
      }
      EXPECT_GT(mended, 20);
    }
}

TEST(Tree_mender, leaves_without_a_change_stay_as_they_are) {
  Face_soup soup(icosphere(30));
  const Region_tree tree(soup.faces, {}, soup.coordinates);
  std::swap(soup.faces[100][0], soup.faces[100][1]);
  auto mended = tree;
  ASSERT_TRUE(mended.mend(soup.faces, Changed{100}, soup.coordinates, {}));
  ASSERT_EQ(mended.leaf_count(), tree.leaf_count());
  for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    EXPECT_TRUE(std::ranges::equal(mended.faces(leaf), tree.faces(leaf)));
  expect_tree(mended, soup, soup.coordinates);
}

TEST(Tree_mender, leaves_without_a_change_are_split_if_they_are_too_full_for_the_options) {
  Face_soup soup(icosphere(20));
  Region_tree tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 96});
  std::swap(soup.faces[100][0], soup.faces[100][1]);
  ASSERT_TRUE(tree.mend(soup.faces, Changed{100}, soup.coordinates, {.leaf_faces = 16}));
  for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf) EXPECT_LE(tree.faces(leaf).size(), 16U);
  expect_tree(tree, soup, soup.coordinates);
}

TEST(Tree_mender, is_the_same_for_any_number_of_workers) {
  std::mt19937_64 random(2);
  Face_soup soup(icosphere(40));
  const Region_tree tree(soup.faces, {}, soup.coordinates);
  const auto changed = change_some(soup, 600, random);
  auto alone = tree, shared = tree;
  Workers workers(2);
  ASSERT_TRUE(alone.mend(soup.faces, changed, soup.coordinates, {}));
  ASSERT_TRUE(shared.mend(soup.faces, changed, soup.coordinates, {}, workers));
  EXPECT_TRUE(std::ranges::equal(shared.all_vertices(), alone.all_vertices()));
  EXPECT_TRUE(std::ranges::equal(shared.volumes(), alone.volumes()));
}

TEST(Tree_mender, parts_without_faces_are_left_out) {
  Face_soup soup(cloth(40, 40));
  Region_tree tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 8});
  while (soup.faces.size() > 10) {
    soup.faces.resize(soup.faces.size() - (soup.faces.size() / 20 + 1));
    const bool mended = tree.mend(soup.faces, {}, soup.coordinates, {.leaf_faces = 8});
    if (!mended) tree = Region_tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 8});
    expect_tree(tree, soup, soup.coordinates);
  }
}

/// Adds a face that touches no other.
void add_piece(Face_soup& soup, double x, double y, double z) {
  const std::uint32_t first = soup.vertex_count();
  soup.coordinates.insert(soup.coordinates.end(), {x, y, z, x + 0.1, y, z, x, y + 0.1, z});
  soup.faces.push_back({first, first + 1, first + 2});
}

TEST(Tree_mender, many_changes_ask_for_a_new_tree) {
  const Face_soup soup(icosphere(10));
  Region_tree tree(soup.faces, {}, soup.coordinates);
  Changed many;
  for (std::uint32_t face = 0; face < soup.faces.size(); face += 4) many.push_back(face);
  EXPECT_FALSE(tree.mend(soup.faces, many, soup.coordinates, {}));
  expect_tree(tree, soup, soup.coordinates);
}

TEST(Tree_mender, a_new_piece_goes_to_the_leaf_beside_it) {
  const Face_soup before(icosphere(20));
  const Region_tree tree(before.faces, {}, before.coordinates, {.leaf_faces = 16});
  for (const double x : {-1.2, 1.2}) {
    auto soup = before;
    add_piece(soup, x, 0, 0);
    auto mended = tree;
    ASSERT_TRUE(mended.mend(soup.faces, {}, soup.coordinates, {.leaf_faces = 16}));
    expect_tree(mended, soup, soup.coordinates);
    const auto new_face = static_cast<std::uint32_t>(before.faces.size());
    std::size_t leaf = 0;
    while (!std::ranges::binary_search(mended.faces(leaf), new_face)) ++leaf;
    for (const std::uint32_t face : mended.faces(leaf))
      EXPECT_LT((soup.point(soup.faces[face][0]) - Kernel::Point_3(x, 0, 0)).squared_length(), 1);
  }
}

TEST(Tree_mender, a_large_new_piece_gets_leaves_of_its_own) {
  const Face_soup before(icosphere(20)), piece(icosphere(5));
  auto soup = before;
  for (auto corners : piece.faces) {
    for (auto& corner : corners) corner += before.vertex_count();
    soup.faces.push_back(corners);
  }
  for (const double x : piece.coordinates) soup.coordinates.push_back(x + 5);
  Region_tree tree(before.faces, {}, before.coordinates);
  ASSERT_TRUE(tree.mend(soup.faces, {}, soup.coordinates, {}));
  expect_tree(tree, soup, soup.coordinates);
}

TEST(Tree_mender, very_many_new_pieces_ask_for_a_new_tree) {
  const Face_soup before(icosphere(40));
  Region_tree tree(before.faces, {}, before.coordinates, {.leaf_faces = 4});
  auto soup = before;
  for (int i = 0; i < 1000; ++i) add_piece(soup, 2 + i, 0, 0);
  EXPECT_FALSE(tree.mend(soup.faces, {}, soup.coordinates, {.leaf_faces = 4}));
  expect_tree(tree, before, before.coordinates);
}

TEST(Tree_mender, a_strip_of_new_faces_is_placed_from_its_first_on) {
  Face_soup soup(icosphere(20));
  Region_tree tree(soup.faces, {}, soup.coordinates);
  std::uint32_t a = soup.faces[0][0], b = soup.faces[0][1];
  std::vector<Corners> strip;
  for (int i = 0; i < 500; ++i) {
    const std::uint32_t next = soup.vertex_count();
    soup.coordinates.insert(soup.coordinates.end(), {1 + 0.01 * i, i % 2 == 0 ? 0.0 : 0.01, 0});
    strip.push_back({a, b, next});
    a = std::exchange(b, next);
  }
  std::ranges::reverse(strip);  // the last touches the surface
  soup.faces.insert(soup.faces.end(), strip.begin(), strip.end());
  ASSERT_TRUE(tree.mend(soup.faces, {}, soup.coordinates, {}));
  expect_tree(tree, soup, soup.coordinates);
}

std::size_t levels_below(const Tree_layout& tree, std::uint32_t node) {
  if (tree.is_leaf(node)) return 1;
  return 1 + std::max(levels_below(tree, node + 1), levels_below(tree, tree.node(node).second_child));
}

TEST(Tree_mender, a_strip_that_grows_at_its_end_never_becomes_a_list) {
  Face_soup soup;
  soup.coordinates = {0, 0, 0, 0, 1, 0};
  const auto grow = [&](int faces) {
    for (int i = 0; i < faces; ++i) {
      const std::uint32_t next = soup.vertex_count();
      soup.coordinates.insert(soup.coordinates.end(), {0.5 * next, next % 2 == 0 ? 0.0 : 1.0, 0});
      soup.faces.push_back({next - 2, next - 1, next});
    }
  };
  grow(400);
  const Region_tree_options options{.leaf_faces = 4};
  Region_tree tree(soup.faces, {}, soup.coordinates, options);
  int mended = 0, made_anew = 0;
  for (int round = 0; round < 600; ++round) {
    grow(8);
    if (tree.mend(soup.faces, {}, soup.coordinates, options)) {
      ++mended;
    } else {
      tree = Region_tree(soup.faces, {}, soup.coordinates, options);
      ++made_anew;
    }
    ASSERT_LE(levels_below(tree, 0), 60U) << "after " << round << " rounds; " << tree.leaf_count() << " leaves";
  }
  expect_tree(tree, soup, soup.coordinates);
  EXPECT_GT(mended, 10 * made_anew);
}

TEST(Tree_mender, a_new_face_beside_leaves_without_a_change_is_placed_in_one_of_them) {
  const Face_soup before(icosphere(20));
  const Region_tree tree(before.faces, {}, before.coordinates);
  for (const bool elsewhere : {false, true}) {  // whether other leaves have a change
    auto soup = before;
    soup.faces.push_back(soup.faces[200]);
    if (elsewhere) std::swap(soup.faces[7000][0], soup.faces[7000][1]);
    auto mended = tree;
    ASSERT_TRUE(mended.mend(soup.faces, elsewhere ? Changed{7000} : Changed{}, soup.coordinates, {}));
    expect_tree(mended, soup, soup.coordinates);
    const auto new_face = static_cast<std::uint32_t>(before.faces.size());
    std::size_t leaf = 0;
    while (!std::ranges::binary_search(mended.faces(leaf), new_face)) ++leaf;
    EXPECT_TRUE(std::ranges::any_of(mended.faces(leaf), [&](std::uint32_t face) {
      return face != new_face &&
             std::ranges::find_first_of(soup.faces[face], soup.faces[new_face]) != soup.faces[face].end();
    }));
  }
}

TEST(Tree_mender, a_coordinate_that_is_not_finite_asks_for_a_new_tree) {
  Face_soup soup(icosphere(20));
  const Region_tree tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 16});
  std::swap(soup.faces[100][0], soup.faces[100][1]);
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const std::uint32_t face : {100U, 5000U}) {
      auto broken = soup;
      broken.coordinates[3 * broken.faces[face][1]] = value;
      for (const std::size_t leaf_faces : {16, 4}) {  // with 4, all leaves are split
        auto mended = tree;
        EXPECT_FALSE(mended.mend(broken.faces, Changed{100}, broken.coordinates, {.leaf_faces = leaf_faces}));
      }
    }
}

TEST(Tree_mender, a_face_may_be_listed_twice) {
  Face_soup soup(icosphere(20));
  Region_tree tree(soup.faces, {}, soup.coordinates);
  std::swap(soup.faces[100][0], soup.faces[100][1]);
  ASSERT_TRUE(tree.mend(soup.faces, Changed{100, 7, 100}, soup.coordinates, {}));
  expect_tree(tree, soup, soup.coordinates);
}

TEST(Tree_mender, no_leaf_grows_beyond_the_most_faces_that_a_leaf_may_hold) {
  Face_soup soup(icosphere(20));
  Region_tree tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 128});
  for (int i = 0; i < 40; ++i) soup.faces.push_back(soup.faces[0]);
  ASSERT_TRUE(tree.mend(soup.faces, {}, soup.coordinates, {.leaf_faces = 128}));
  for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf) EXPECT_LE(tree.faces(leaf).size(), 128U);
  expect_tree(tree, soup, soup.coordinates);
}

TEST(Tree_mender, many_nearly_empty_leaves_ask_for_a_new_tree) {
  auto soup = shuffled(Face_soup(icosphere(20)), 1);
  Region_tree tree(soup.faces, {}, soup.coordinates);
  soup.faces.resize(soup.faces.size() / 8);
  EXPECT_FALSE(tree.mend(soup.faces, {}, soup.coordinates, {}));
}

}  // namespace
}  // namespace lodestone
