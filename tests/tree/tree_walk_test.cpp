// SPDX-License-Identifier: GPL-3.0-or-later
// Walks over trees, mostly as `tree_contacts.h` uses them.
#include "lodestone/tree/tree_walk.h"

#include <gtest/gtest.h>

#include <limits>

#include "lodestone/queries/visit_contacts.h"
#include "support/face_soup.h"
#include "support/instruction_sets.h"

namespace lodestone {
namespace {

Aabb box(double low, double high) {
  return {.low = {low, low, low, std::nan("")}, .high = {high, high, high, std::nan("")}};
}

TEST(Aabb, is_near_another_that_it_touches_along_every_axis) {
  const Aabb a = box(0, 1);
  EXPECT_TRUE(near(a, box(1, 2), 0));
  EXPECT_TRUE(near(a, box(-1, 0), 0));
  EXPECT_TRUE(near(a, box(0.25, 0.5), 0));
  for (int axis = 0; axis < 3; ++axis) {
    Aabb above = a, below = a;
    above.low[axis] = std::nextafter(1, 2), above.high[axis] = 2;
    below.high[axis] = -std::numeric_limits<double>::denorm_min(), below.low[axis] = -1;
    for (const auto& apart : {above, below}) {
      EXPECT_FALSE(near(a, apart, 0));
      EXPECT_FALSE(near(apart, a, 0));
      EXPECT_TRUE(near(a, apart, 1e-15));
      EXPECT_TRUE(near(apart, a, 1e-15));
    }
  }
}

TEST(Aabb, is_near_whatever_is_not_farther_than_the_margin) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1, 1), exponent(-60, 0);
  std::size_t far = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const double low = place(random), high = low + std::exp2(exponent(random)), margin = std::exp2(exponent(random));
    const double next = high + margin * (trial % 2 == 0 ? 1 : 1 + 0x1p-50);
    const bool apart = CGAL::Gmpq(next) - CGAL::Gmpq(high) > CGAL::Gmpq(margin);
    if (!near(box(low, high), box(next, 2 * std::abs(next) + 9), margin)) {
      ++far;
      ASSERT_TRUE(apart);
    }
  }
  EXPECT_GT(far, 1000U);
}

TEST(Aabb, has_the_sum_of_its_sides_as_extent) {
  EXPECT_EQ((Aabb{.low = {0, -1, 2, 7}, .high = {1, 1, 6, 0}}.extent()), 7);
  EXPECT_EQ(box(-1e308, 1e308).extent(), std::numeric_limits<double>::infinity());
}

using Leaves = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST(Walk, meets_the_pairs_of_near_leaves_each_once) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  std::size_t most = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (const double margin : {0.0, 0.1, 10.0}) {
      const Posed_object a(posed_at_random(objects[i].second, 0.7, random), 8);
      const Posed_object b(posed_at_random(objects[(i + 1) % objects.size()].second, 0.7, random), 5);
      const Region_tree &s = a.object().tree(), &t = b.object().tree();
      Leaves expected;
      for (std::uint32_t p = 0; p < s.leaf_count(); ++p)
        for (std::uint32_t q = 0; q < t.leaf_count(); ++q)
          if (near(s.volume(s.leaf_node(p)), t.volume(t.leaf_node(q)), margin)) expected.emplace_back(p, q);
      most = std::max(most, expected.size());
      for_instruction_sets([&] {
        Leaves met;
        std::vector<Node_pair> ahead{{0, 0}};
        EXPECT_EQ(walk_leaf_pairs(s, t, margin, ahead,
                                  [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
                                    met.emplace_back(leaf_a, leaf_b);
                                    return Visit::go_on;
                                  }),
                  Visit::go_on);
        EXPECT_TRUE(ahead.empty());
        std::ranges::sort(met);
        EXPECT_EQ(met, expected);
      });
    }
  EXPECT_GT(most, std::size_t{bunch_leaves} * bunch_leaves) << "more than are compared at a time";
}

TEST(Walk, within_a_tree_meets_near_leaves_once_and_each_with_itself) {
  for (const auto& [name, soup] : small_objects()) {
    const Posed_object object(soup, 5);
    const Region_tree& tree = object.object().tree();
    Leaves met, expected;
    std::vector<Node_pair> ahead{{0, 0}};
    walk_leaf_pairs_within(tree, ahead, [&](std::uint32_t a, std::uint32_t b) {
      met.push_back(std::minmax(a, b));
      return Visit::go_on;
    });
    for (std::uint32_t p = 0; p < tree.leaf_count(); ++p)
      for (std::uint32_t q = p; q < tree.leaf_count(); ++q)
        if (p == q || near(tree.volume(tree.leaf_node(p)), tree.volume(tree.leaf_node(q)), 0))
          expected.emplace_back(p, q);
    std::ranges::sort(met);
    EXPECT_EQ(met, expected) << name;
  }
}

/// Counts contacts and stops at the `last`.
struct Counter {
  std::size_t last;
  std::size_t calls = 0;
  Visit operator()(Face_pair) { return ++calls == last ? Visit::stop : Visit::go_on; }
};

/// Calls `visit(walk, counter)` with counters that stop at many of the contacts, the last one too, and at none.
template <class Walk_to>
void expect_stops(std::size_t contacts, const Walk_to& visit) {
  Tree_walk walk;
  std::size_t tests_before = 0;
  std::vector<std::size_t> stops;
  for (std::size_t last = 1; last < contacts; last += 1 + contacts / 50) stops.push_back(last);
  for (const std::size_t last : {contacts, contacts + 1}) stops.push_back(last);
  for (const std::size_t last : stops) {
    Counter counter{last};
    walk.ahead = {{0, 0}};
    const std::size_t before = walk.exact_tests;
    EXPECT_EQ(visit(walk, counter), last <= contacts ? Visit::stop : Visit::go_on);
    EXPECT_EQ(counter.calls, std::min(last, contacts));
    if (last > contacts) {
      EXPECT_TRUE(walk.ahead.empty());
    }
    EXPECT_GE(walk.exact_tests - before, std::max(tests_before, counter.calls)) << "a longer walk of the same order";
    tests_before = walk.exact_tests - before;
  }
  EXPECT_GT(walk.leaf_tests, 0U);
}

TEST(Visit_contacts, goes_on_where_it_stopped_after_so_many_pairs_of_leaves) {
  const Posed_object a(icosphere(5)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  const auto truth = true_pairs(a.soup(), b.soup());
  Tree_walk walk;
  walk.ahead = {{0, 0}};
  std::vector<Face_pair> found;
  std::size_t stops = 0;
  for (Visit visit = Visit::stop; visit == Visit::stop; ++stops) {
    walk.last_leaf_test = walk.leaf_tests + 2;
    visit = visit_contacts(a.view(), b.view(), 0, walk, [&](Face_pair pair) {
      found.push_back(pair);
      return Visit::go_on;
    });
    EXPECT_LE(walk.leaf_tests, walk.last_leaf_test);
  }
  std::ranges::sort(found);
  EXPECT_EQ(found, truth);
  EXPECT_GT(stops, 3U);
}

TEST(Visit_contacts, ends_where_the_visitor_says_so) {
  const Posed_object a(icosphere(5)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  const auto truth = true_pairs(a.soup(), b.soup());
  ASSERT_GT(truth.size(), 50U);
  expect_stops(truth.size(),
               [&](Tree_walk& walk, Counter& counter) { return visit_contacts(a.view(), b.view(), 0, walk, counter); });
}

std::vector<Face_pair> contacts_within(const Posed_object& object) {
  std::vector<Face_pair> found;
  Tree_walk walk;
  walk.ahead = {{0, 0}};
  visit_contacts_within(object.view(), walk, [&](Face_pair pair) {
    found.push_back(pair);
    return Visit::go_on;
  });
  std::ranges::sort(found);
  return found;
}

TEST(Visit_contacts, within_a_mesh_finds_faces_that_share_no_vertex_and_ends_where_the_visitor_says_so) {
  for (const auto& soup : {crumpled(icosphere(4), 0.1, 1), lattice_soup(150, 60, 6, 1)}) {
    std::vector<Face_pair> truth;
    for (const auto pair : true_pairs(soup, soup)) {
      const auto &a = soup.faces[pair.a], &b = soup.faces[pair.b];
      if (pair.a < pair.b && std::ranges::find_first_of(a, b) == a.end()) truth.push_back(pair);
    }
    for (const std::size_t leaf_faces : {2, 16, 128}) {
      const Posed_object object(soup, leaf_faces);
      EXPECT_EQ(contacts_within(object), truth);
      expect_stops(truth.size(), [&](Tree_walk& walk, Counter& counter) {
        return visit_contacts_within(object.view(), walk, counter);
      });
    }
  }
}

/// The nodes `levels` below the root, or leaves above them.
std::vector<std::uint32_t> nodes_at(const Region_tree& tree, int levels) {
  std::vector<std::uint32_t> nodes{0};
  for (; levels > 0; --levels) {
    std::vector<std::uint32_t> next;
    for (const auto n : nodes) {
      if (tree.is_leaf(n))
        next.push_back(n);
      else
        next.insert(next.end(), {n + 1, tree.node(n).second_child});
    }
    nodes = next;
  }
  return nodes;
}

TEST(Visit_contacts, from_several_nodes_finds_the_same_as_from_the_roots) {
  const Posed_object a(icosphere(6), 8), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}), 12);
  const auto truth = true_pairs(a.soup(), b.soup());
  for (const int levels : {0, 1, 3, 20}) {
    Tree_walk together, apart;
    std::vector<Face_pair> found_together, found_apart;
    const auto add_to = [](std::vector<Face_pair>& found) {
      return [&found](Face_pair pair) {
        found.push_back(pair);
        return Visit::go_on;
      };
    };
    for (const auto n : nodes_at(a.object().tree(), levels))
      for (const auto m : nodes_at(b.object().tree(), levels)) {
        together.ahead.push_back({n, m});
        apart.ahead = {{n, m}};
        visit_contacts(a.view(), b.view(), 0, apart, add_to(found_apart));
      }
    visit_contacts(a.view(), b.view(), 0, together, add_to(found_together));
    std::ranges::sort(found_together), std::ranges::sort(found_apart);
    EXPECT_EQ(found_together, truth) << levels;
    EXPECT_EQ(found_apart, truth) << levels;
    EXPECT_EQ(together.leaf_tests, apart.leaf_tests);
    EXPECT_EQ(together.exact_tests, apart.exact_tests);
  }
}

TEST(Visit_contacts, opens_only_what_is_near) {
  const Posed_object a(icosphere(30)), b(placed(icosphere(30), 1, 1.05));  // meet in a small cap
  Tree_walk walk;
  walk.ahead = {{0, 0}};
  Counter counter{0};
  visit_contacts(a.view(), b.view(), 0, walk, counter);
  EXPECT_GT(counter.calls, 0U);
  EXPECT_LT(walk.leaf_tests, a.object().tree().leaf_count());
  EXPECT_LT(walk.exact_tests, 20 * counter.calls);
}

}  // namespace
}  // namespace lodestone
