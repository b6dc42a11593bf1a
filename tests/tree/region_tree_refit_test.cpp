// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "support/guarded_coordinates.h"
#include "support/instruction_sets.h"
#include "support/special_numbers.h"
#include "support/tree_checks.h"

namespace lodestone {
namespace {

constexpr double most = std::numeric_limits<double>::max();

TEST(Region_tree_refit, parts_in_any_order_give_the_same_boxes) {
  std::mt19937_64 random(1);
  for (const auto& soup : {Face_soup(icosphere(71)), Face_soup(icosphere(5)), Face_soup(single_triangle())}) {
    Region_tree whole(soup.faces, octants(soup), soup.coordinates);
    Region_tree parts = whole;
    std::vector<std::size_t> order(parts.part_count());
    std::iota(order.begin(), order.end(), 0U);
    EXPECT_EQ(order.size() > 1, soup.faces.size() > 100000);
    for (int frame = 0; frame < 5; ++frame) {
      const auto now = crumpled(soup, 0.1, frame);
      ASSERT_TRUE(whole.refit(now.coordinates));
      std::ranges::shuffle(order, random);
      for (const auto part : order) parts.refit_part(part, now.coordinates);
      ASSERT_TRUE(parts.finish_refit(now.coordinates));
      expect_equal_boxes(parts, whole);
    }
    Workers workers(3);
    workers.run(order.size(), [&](std::size_t part, std::size_t) { parts.refit_part(part, soup.coordinates); });
    ASSERT_TRUE(parts.finish_refit(soup.coordinates));
    ASSERT_TRUE(whole.refit(soup.coordinates));
    expect_equal_boxes(parts, whole);
  }
}

TEST(Region_tree_refit, every_instruction_set_gives_the_same_boxes) {
  const auto soup = shuffled(Face_soup(icosphere(20)), 1);
  const auto now = crumpled(soup, 0.3, 1);
  for (const std::size_t leaf_faces : {2, 3, 5, 64}) {
    Region_tree best(soup.faces, {}, soup.coordinates, {.leaf_faces = leaf_faces}), other = best;
    ASSERT_TRUE(best.refit(now.coordinates));
    for_instruction_sets([&] {
      ASSERT_TRUE(other.refit(soup.coordinates));
      ASSERT_TRUE(other.refit(now.coordinates));
      expect_tree(other, soup, now.coordinates);
      expect_equal_boxes(other, best);
    });
  }
}

TEST(Region_tree_refit, never_reads_past_the_last_vertex) {
  for (const auto& [name, soup] : tree_cases())
    for (const std::size_t leaf_faces : {2, 3, 64})
      for_instruction_sets([&, &mesh = soup] {
        const Guarded_coordinates guarded(mesh.coordinates);
        Region_tree tree(mesh.faces, {}, guarded.values(), {.leaf_faces = leaf_faces});
        EXPECT_TRUE(tree.refit(guarded.values()));
        EXPECT_EQ(tree.validate(mesh.faces, guarded.values()), "");
      });
}

TEST(Region_tree_refit, a_non_finite_coordinate_of_any_vertex_is_reported) {
  for (const auto& soup : {Face_soup(single_triangle()), Face_soup(icosphere(2)), shuffled(Face_soup(cloth(5, 5)), 1)})
    for_instruction_sets([&] {
      Region_tree tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 4}), good = tree;
      auto now = soup.coordinates;
      for (double& x : now)
        for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
          const double before = std::exchange(x, bad);
          EXPECT_FALSE(tree.refit(now));
          x = before;
        }
      EXPECT_TRUE(tree.refit(now)) << "recovers";
      expect_equal_boxes(tree, good);
    });
}

TEST(Region_tree_refit, one_bad_coordinate_in_a_hundred_thousand_and_infinities_that_cancel_are_reported) {
  const Face_soup soup(icosphere(71));
  Region_tree tree(soup.faces, octants(soup), soup.coordinates);
  const std::size_t count = soup.coordinates.size();
  for (const std::size_t index : {std::size_t{0}, std::size_t{1}, count / 2, count - 2, count - 1}) {
    auto now = soup.coordinates;
    now[index] = infinity;
    EXPECT_FALSE(tree.refit(now));
    now[count - 1 - index] = -infinity;
    EXPECT_FALSE(tree.refit(now));
  }
}

TEST(Region_tree_refit, the_largest_finite_coordinates_are_accepted) {
  for (const auto& base : {Face_soup(icosphere(3)), Face_soup(icosphere(71))}) {
    Region_tree tree(base.faces, {}, base.coordinates);
    for (const double size : {1e308, most}) {
      auto now = base.coordinates;
      for (double& x : now) x = x < 0 ? -size : size;
      EXPECT_TRUE(tree.refit(now));
      expect_tree(tree, base, now);
      for (double& x : now) x = size;
      EXPECT_TRUE(tree.refit(now));
      expect_tree(tree, base, now);
      const Region_tree built(base.faces, {}, now);
      expect_tree(built, base, now);
      now[now.size() / 2] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_FALSE(tree.refit(now));
    }
  }
}

/// Coordinates of few digits, so that sums of them and powers of two are exact.
Face_soup rounded(Face_soup soup) {
  for (double& x : soup.coordinates) x = 0x1p-16 * std::round(0x1p16 * x);
  return soup;
}

TEST(Region_tree_refit, looseness_does_not_change_when_a_mesh_is_moved_turned_or_scaled) {
  const auto soup = rounded(Face_soup(torus_knot()));
  Region_tree tree(soup.faces, octants(soup), soup.coordinates);
  const double looseness = tree.looseness();
  EXPECT_GT(looseness, 0);
  EXPECT_LT(looseness, 1);
  for (const double factor : {0x1p-900, 0x1p-300, 0.5, 64.0, 0x1p300, 0x1p900}) {
    ASSERT_TRUE(tree.refit(placed(soup, factor).coordinates));
    EXPECT_EQ(tree.looseness(), looseness) << factor;
  }
  for (const double offset : {-4.0, 0x1p12}) {
    ASSERT_TRUE(tree.refit(placed(soup, 1, offset).coordinates));
    EXPECT_EQ(tree.looseness(), looseness) << offset;
  }
  auto turned = soup;
  deform(turned, [](const Point& p) { return Point(-p.y(), p.z(), -p.x()); });
  ASSERT_TRUE(tree.refit(turned.coordinates));
  EXPECT_EQ(tree.looseness(), looseness);
}

TEST(Region_tree_refit, looseness_grows_when_leaves_are_pulled_apart) {
  const Face_soup soup(icosphere(20));
  Region_tree tree(soup.faces, octants(soup), soup.coordinates);
  double before = tree.looseness();
  for (const double distance : {0.05, 0.1, 0.2, 0.5, 2.0}) {
    ASSERT_TRUE(tree.refit(crumpled(soup, distance, 1).coordinates));
    EXPECT_GT(tree.looseness(), 1.1 * before);
    before = tree.looseness();
  }
}

TEST(Region_tree_refit, looseness_is_one_for_a_single_leaf_and_zero_for_a_point) {
  const Face_soup triangle(single_triangle());
  Region_tree tree(triangle.faces, {}, triangle.coordinates);
  EXPECT_EQ(tree.looseness(), 1);
  ASSERT_TRUE(tree.refit(std::vector(9, 5.0)));
  EXPECT_EQ(tree.looseness(), 0);
}

}  // namespace
}  // namespace lodestone
