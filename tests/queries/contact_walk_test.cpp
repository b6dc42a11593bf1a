// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/contact_walk.h"

#include <gtest/gtest.h>

#include "support/face_soup.h"

namespace lodestone {
namespace {

/// Counts contacts and stops at the `last`.
struct Counter {
  std::size_t last;
  std::size_t calls = 0;
  Visit operator()(Face_pair) { return ++calls == last ? Visit::stop : Visit::go_on; }
};

/// The contacts that a walk visits in runs of at most `budget` leaf pairs each, in their order.
std::vector<Face_pair> visited(Contact_walk<Aabb>& walk, std::size_t budget = no_budget) {
  std::vector<Face_pair> found;
  while (!walk.done())
    walk.run(
        [&](Face_pair pair) {
          found.push_back(pair);
          return Visit::go_on;
        },
        budget);
  return found;
}

std::vector<Face_pair> sorted(std::vector<Face_pair> pairs) {
  std::ranges::sort(pairs);
  return pairs;
}

/// Checks a walk with visitors that stop at many of the contacts, the last one too, and at none. `begin(walk)` begins
/// it.
template <class Begin>
void expect_stops(std::size_t contacts, const Begin& begin) {
  Contact_walk<Aabb> walk;
  std::vector<std::size_t> stops;
  for (std::size_t last = 1; last < contacts; last += 1 + contacts / 50) stops.push_back(last);
  for (const std::size_t last : {contacts, contacts + 1}) stops.push_back(last);
  std::size_t tests_before = 0;
  for (const std::size_t last : stops) {
    Counter counter{last};
    begin(walk);
    EXPECT_EQ(walk.leaf_tests() + walk.exact_tests(), 0U);
    EXPECT_EQ(walk.run(counter), last <= contacts ? Visit::stop : Visit::go_on);
    EXPECT_EQ(counter.calls, std::min(last, contacts));
    if (last > contacts) {
      EXPECT_TRUE(walk.done());
    }
    EXPECT_GT(walk.leaf_tests(), 0U);
    EXPECT_GE(walk.exact_tests(), std::max(tests_before, counter.calls)) << "a longer walk in the same order";
    tests_before = walk.exact_tests();
  }
}

TEST(Contact_walk, finds_the_same_contacts_in_the_same_order_in_runs_of_a_few_leaf_pairs) {
  const Posed_object a(icosphere(5)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  Contact_walk<Aabb> walk;
  walk.begin(a.view(), b.view(), 0);
  const auto whole = visited(walk);
  const std::size_t leaf_tests = walk.leaf_tests(), exact_tests = walk.exact_tests();
  EXPECT_EQ(sorted(whole), true_pairs(a.soup(), b.soup()));
  EXPECT_GT(leaf_tests, 10U);
  for (const std::size_t budget : {1, 2, 5}) {
    walk.begin(a.view(), b.view(), 0);
    EXPECT_EQ(visited(walk, budget), whole);
    EXPECT_EQ(walk.leaf_tests(), leaf_tests);
    EXPECT_EQ(walk.exact_tests(), exact_tests);
  }
}

TEST(Contact_walk, ends_where_the_visitor_stops_it) {
  const Posed_object a(icosphere(5)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  const auto truth = true_pairs(a.soup(), b.soup());
  ASSERT_GT(truth.size(), 50U);
  expect_stops(truth.size(), [&](Contact_walk<Aabb>& walk) { walk.begin(a.view(), b.view(), 0); });
  for (const std::size_t last : {std::size_t{1}, truth.size(), truth.size() + 1}) {
    Counter counter{last};
    EXPECT_EQ(visit_contacts(a.view(), b.view(), 0, counter), last <= truth.size() ? Visit::stop : Visit::go_on);
    EXPECT_EQ(counter.calls, std::min(last, truth.size()));
  }
}

TEST(Contact_walk, within_a_mesh_finds_faces_that_share_no_vertex_and_ends_where_the_visitor_stops_it) {
  for (const auto& soup : {crumpled(icosphere(4), 0.1, 1), lattice_soup(150, 60, 6, 1)}) {
    std::vector<Face_pair> truth;
    for (const auto pair : true_pairs(soup, soup)) {
      const auto &a = soup.faces[pair.a], &b = soup.faces[pair.b];
      if (pair.a < pair.b && std::ranges::find_first_of(a, b) == a.end()) truth.push_back(pair);
    }
    for (const std::size_t leaf_faces : {2, 16, 128}) {
      const Posed_object object(soup, leaf_faces);
      Contact_walk<Aabb> walk;
      walk.begin_within(object.view());
      EXPECT_EQ(sorted(visited(walk)), truth);
      expect_stops(truth.size(), [&](Contact_walk<Aabb>& again) { again.begin_within(object.view()); });
    }
  }
}

TEST(Contact_walk, is_reused_for_other_trees_and_other_positions) {
  const Posed_object ball(icosphere(5)), knot(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  const Posed_object folded(crumpled(icosphere(4), 0.1, 1));
  Contact_walk<Aabb> reused;
  const auto expect_as_new = [&](const auto& begin) {
    Contact_walk<Aabb> fresh;
    begin(fresh);
    begin(reused);
    const auto expected = visited(fresh);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(visited(reused), expected);
    EXPECT_EQ(reused.leaf_tests(), fresh.leaf_tests());
    EXPECT_EQ(reused.exact_tests(), fresh.exact_tests());
  };
  Posed_object moving(icosphere(5));
  std::mt19937_64 random(1);
  for (int frame = 0; frame < 3; ++frame) {
    moving.move_to(posed_at_random(ball.soup(), 0.3, random));
    expect_as_new([&](Contact_walk<Aabb>& walk) { walk.begin(moving.view(), knot.view(), 0); });
    expect_as_new([&](Contact_walk<Aabb>& walk) { walk.begin_within(folded.view()); });
    expect_as_new([&](Contact_walk<Aabb>& walk) { walk.begin(knot.view(), ball.view(), 0.01); });
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

TEST(Contact_walk, from_all_pairs_of_nodes_of_a_level_finds_the_same_as_from_the_roots) {
  const Posed_object a(icosphere(6), 8), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}), 12);
  Contact_walk<Aabb> whole;
  whole.begin(a.view(), b.view(), 0);
  const auto truth = sorted(visited(whole));
  EXPECT_EQ(truth, true_pairs(a.soup(), b.soup()));
  for (const int levels : {0, 1, 3, 20}) {
    Contact_walk<Aabb> walk;
    walk.begin(a.view(), b.view(), 0);
    std::vector<Face_pair> found;
    std::size_t leaf_tests = 0, exact_tests = 0;
    for (const auto n : nodes_at(a.object().tree(), levels))
      for (const auto m : nodes_at(b.object().tree(), levels)) {
        walk.start({n, m});
        const auto below = visited(walk);
        found.insert(found.end(), below.begin(), below.end());
        leaf_tests += walk.leaf_tests(), exact_tests += walk.exact_tests();
      }
    EXPECT_EQ(sorted(found), truth) << levels;
    EXPECT_EQ(leaf_tests, whole.leaf_tests());
    EXPECT_EQ(exact_tests, whole.exact_tests());
  }
}

TEST(Contact_walk, tests_few_leaf_pairs_and_face_pairs_where_two_surfaces_meet_in_a_small_cap) {
  const Posed_object a(icosphere(30)), b(placed(icosphere(30), 1, 1.05));
  Contact_walk<Aabb> walk;
  Counter counter{0};
  walk.begin(a.view(), b.view(), 0);
  walk.run(counter);
  EXPECT_GT(counter.calls, 0U);
  EXPECT_LT(walk.leaf_tests(), a.object().tree().leaf_count());
  EXPECT_LT(walk.exact_tests(), 20 * counter.calls);
}

}  // namespace
}  // namespace lodestone
