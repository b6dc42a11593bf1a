// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/tree_walk.h"

#include <gtest/gtest.h>

#include "lodestone/volumes/bounding_sphere.h"
#include "support/face_soup.h"
#include "support/instruction_sets.h"

namespace lodestone {
namespace {

using Leaf_pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// What a walk visits in runs of at most `budget` leaf pairs each.
template <class Volume>
Leaf_pairs visited(Tree_walk<Volume>& walk, std::size_t budget = no_budget) {
  Leaf_pairs pairs;
  const auto visit = [&](std::uint32_t a, std::uint32_t b) {
    pairs.emplace_back(a, b);
    return Visit::go_on;
  };
  for (std::size_t runs = 1; walk.run(visit, budget) == Visit::stop; ++runs) {
    EXPECT_EQ(walk.leaf_tests(), runs * budget);
    EXPECT_EQ(pairs.size(), runs * budget);
  }
  EXPECT_TRUE(walk.done());
  EXPECT_EQ(walk.leaf_tests(), pairs.size());
  return pairs;
}

TEST(Tree_walk, visits_each_candidate_leaf_pair_once) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  std::size_t most_pairs = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (const double margin : {0.0, 0.1, 10.0}) {
      const Posed_object a(posed_at_random(objects[i].second, 0.7, random), 8);
      const Posed_object b(posed_at_random(objects[(i + 1) % objects.size()].second, 0.7, random), 5);
      const Region_tree &s = a.object().tree(), &t = b.object().tree();
      Leaf_pairs expected;
      for (std::uint32_t p = 0; p < s.leaf_count(); ++p)
        for (std::uint32_t q = 0; q < t.leaf_count(); ++q)
          if (near(s.volume(s.leaf_node(p)), t.volume(t.leaf_node(q)), margin)) expected.emplace_back(p, q);
      most_pairs = std::max(most_pairs, expected.size());
      Tree_walk<Aabb> walk;
      for_instruction_sets([&] {
        walk.begin(s, t, margin);
        auto pairs = visited(walk);
        std::ranges::sort(pairs);
        EXPECT_EQ(pairs, expected);
      });
    }
  EXPECT_GT(most_pairs, std::size_t{bunch_leaves} * bunch_leaves) << "more than are compared at a time";
}

TEST(Tree_walk, self_walk_visits_each_candidate_leaf_pair_once_and_each_leaf_with_itself) {
  for (const auto& [name, soup] : small_objects()) {
    const Posed_object object(soup, 5);
    const Region_tree& tree = object.object().tree();
    Tree_walk<Aabb> walk;
    walk.begin_within(tree, 0);
    auto pairs = visited(walk);
    for (auto& pair : pairs) pair = std::minmax({pair.first, pair.second});
    Leaf_pairs expected;
    for (std::uint32_t p = 0; p < tree.leaf_count(); ++p)
      for (std::uint32_t q = p; q < tree.leaf_count(); ++q)
        if (p == q || near(tree.volume(tree.leaf_node(p)), tree.volume(tree.leaf_node(q)), 0))
          expected.emplace_back(p, q);
    std::ranges::sort(pairs);
    EXPECT_EQ(pairs, expected) << name;
  }
}

template <class Volume>
class Interrupted_walk : public testing::Test {
 protected:
  using Tree = Basic_region_tree<Volume>;

  static Tree tree(const Face_soup& soup) { return {soup.faces, octants(soup), soup.coordinates, {.leaf_faces = 5}}; }

  /// Calls `check(walk, begin)` for a walk over two trees and for a self-walk; `begin()` begins it anew.
  template <class Check>
  void for_walks(const Check& check) {
    Tree_walk<Volume> walk;
    check(walk, [&] { walk.begin(a_, b_, 0.01); });
    check(walk, [&] { walk.begin_within(b_, 0); });
  }

 private:
  Tree a_ = tree(icosphere(8));
  Tree b_ = tree(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
};
using Volumes = testing::Types<Aabb, Bounding_sphere>;
TYPED_TEST_SUITE(Interrupted_walk, Volumes);

TYPED_TEST(Interrupted_walk, goes_on_in_the_same_order_after_the_budget_is_used_up) {
  this->for_walks([](auto& walk, const auto& begin) {
    begin();
    const Leaf_pairs whole = visited(walk);
    ASSERT_GT(whole.size(), 100U);
    for (const std::size_t budget : {std::size_t{1}, std::size_t{2}, std::size_t{7}, whole.size()}) {
      begin();
      EXPECT_EQ(visited(walk, budget), whole);
    }
    begin();
    EXPECT_EQ(walk.run([](std::uint32_t, std::uint32_t) { return Visit::go_on; }, 0), Visit::stop);
    EXPECT_EQ(walk.leaf_tests(), 0U);
  });
}

TYPED_TEST(Interrupted_walk, goes_on_in_the_same_order_after_the_visitor_stops_it) {
  this->for_walks([](auto& walk, const auto& begin) {
    begin();
    const Leaf_pairs whole = visited(walk);
    begin();
    Leaf_pairs pairs;
    const auto visit = [&](std::uint32_t a, std::uint32_t b) {
      pairs.emplace_back(a, b);
      return pairs.size() % 3 == 0 ? Visit::stop : Visit::go_on;
    };
    std::size_t stops = 0;
    while (walk.run(visit) == Visit::stop) EXPECT_EQ(pairs.size(), 3 * ++stops);
    EXPECT_EQ(pairs, whole);
  });
}

TYPED_TEST(Interrupted_walk, split_after_any_part_is_finished_in_the_same_order_by_its_pieces) {
  this->for_walks([](auto& walk, const auto& begin) {
    begin();
    const Leaf_pairs whole = visited(walk);
    for (const std::size_t before : {std::size_t{0}, std::size_t{1}, std::size_t{40}, whole.size()})
      for (const std::size_t more : {0, 1, 10, 200, 100'000}) {
        begin();
        Leaf_pairs pairs;
        walk.run(
            [&](std::uint32_t a, std::uint32_t b) {
              pairs.emplace_back(a, b);
              return Visit::go_on;
            },
            before);
        std::vector<Node_pair> starts{{7, 7}};
        walk.split(more, starts);
        EXPECT_TRUE(walk.done());
        EXPECT_GE(starts.size() + before, std::min(more, whole.size()));
        for (const Node_pair start : starts) {
          walk.start(start);
          const Leaf_pairs piece = visited(walk);
          pairs.insert(pairs.end(), piece.begin(), piece.end());
        }
        EXPECT_EQ(pairs, whole) << before << ' ' << more;
      }
  });
}

}  // namespace
}  // namespace lodestone
