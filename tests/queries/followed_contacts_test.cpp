// SPDX-License-Identifier: GPL-3.0-or-later
// Opening_search::follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/opening_search.h"
#include "support/owned_surface.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

const std::vector<Opening_start> root_start{{{0, 0}, 0}};

/// A surface with a tree that was built from another pose.
class Followed_object {
 public:
  explicit Followed_object(const Face_soup& now, std::size_t leaf_faces = 8, bool seams_closed = false)
      : Followed_object(now, now, leaf_faces, seams_closed) {}
  Followed_object(const Face_soup& rest, const Face_soup& now, std::size_t leaf_faces, bool seams_closed)
      : surface_(now, seams_closed),
        tree_(rest.faces, octants(rest), rest.coordinates, {.leaf_faces = leaf_faces}),
        neighbours_(tree_.layout(), now.faces.size()) {}

  void start_frame() { tree_.start_frame(*surface_.view().positions); }
  Owned_surface& surface() { return surface_; }
  Tree_on_demand& tree() { return tree_; }
  Leaf_neighbours& neighbours() {
    neighbours_.look_at(tree_.layout(), surface_.walked(), *surface_.view().vertex_faces);
    return neighbours_;
  }

 private:
  Owned_surface surface_;
  Tree_on_demand tree_;
  Leaf_neighbours neighbours_;
};

std::vector<Face_pair> true_contacts(Followed_object& a, Followed_object& b) {
  return true_pairs(a.surface().soup(), b.surface().soup());
}

/// What is followed from some contacts, of leaves that have not been compared.
std::vector<Face_pair> followed_from(Opening_search& search, Followed_object& a, Followed_object& b,
                                     const std::vector<Face_pair>& contacts) {
  a.start_frame(), b.start_frame();
  search.begin(a.tree(), b.tree(), {.all = true});
  std::vector<Face_pair> found{{999, 999}};
  search.follow(a.neighbours(), b.neighbours(), {.contacts = contacts}, found);
  EXPECT_EQ(found.front(), (Face_pair{999, 999})) << "what was found before must stay";
  found.erase(found.begin());
  std::ranges::sort(found);
  EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
  return found;
}

bool are_unique(std::vector<Leaf_pair> leaves) {
  std::ranges::sort(leaves);
  return std::ranges::adjacent_find(leaves) == leaves.end();
}

bool share_an_edge(const Corners& f, const Corners& g) {
  return std::ranges::count_if(f, [&](auto corner) { return std::ranges::find(g, corner) != g.end(); }) >= 2;
}

/// The leaves with a face that shares an edge with this one.
std::vector<std::uint32_t> leaves_beside(Followed_object& object, std::uint32_t face) {
  const auto& walked = object.surface().walked();
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t other = 0; other < walked.size(); ++other)
    if (share_an_edge(walked[face], walked[other])) leaves.push_back(object.neighbours().leaf_of(other));
  return leaves;
}

/// By the definition: the contacts in the two leaves of this one, and in those beside wherever one was reached.
std::vector<Face_pair> reached_from(Followed_object& a, Followed_object& b, const std::vector<Face_pair>& truth,
                                    Face_pair contact) {
  const auto leaves_of = [&](Face_pair pair) {
    return Leaf_pair{a.neighbours().leaf_of(pair.a), b.neighbours().leaf_of(pair.b)};
  };
  std::vector<Leaf_pair> leaves{leaves_of(contact)};
  const auto add = [&](Leaf_pair pair) {
    if (std::ranges::find(leaves, pair) == leaves.end()) leaves.push_back(pair);
  };
  std::vector<Face_pair> reached;
  for (std::size_t done = 0; done < leaves.size(); ++done)
    for (const auto& here : truth) {
      const Leaf_pair both = leaves[done];
      if (leaves_of(here) != both) continue;
      reached.push_back(here);
      for (const auto leaf : leaves_beside(a, here.a)) add({leaf, both.b});
      for (const auto leaf : leaves_beside(b, here.b)) add({both.a, leaf});
    }
  std::ranges::sort(reached);
  return reached;
}

TEST(Followed_contacts, of_two_spheres_are_all_from_any_of_them) {
  Opening_search search;
  for (const std::size_t leaf_faces : {4, 30, 96}) {
    Followed_object a(sphere(12), leaf_faces), b(moved(sphere(10), 1.3, 0.2, 0.1), leaf_faces);
    const auto truth = true_contacts(a, b);
    for (const Face_pair contact : truth) EXPECT_EQ(followed_from(search, a, b, {contact}), truth);
    EXPECT_EQ(followed_from(search, a, b, truth), truth);
    EXPECT_EQ(followed_from(search, a, b, {truth[3], truth[7], truth[3]}), truth) << "known twice";
    EXPECT_TRUE(followed_from(search, a, b, {}).empty());
    EXPECT_EQ(search.leaf_tests(), 0U);
  }
}

TEST(Followed_contacts, are_the_whole_curve_for_objects_of_any_kind) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  Opening_search search;
  std::size_t several = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Followed_object a(posed_at_random(objects[i].second, 0.3, random), 4);
    Followed_object b(posed_at_random(objects[(i + 1) % objects.size()].second, 0.3, random), 4);
    const auto truth = true_contacts(a, b);
    ASSERT_FALSE(truth.empty());
    for (std::size_t contact = 0; contact < truth.size(); contact += 1 + truth.size() / 5) {
      const auto expected = reached_from(a, b, truth, truth[contact]);
      EXPECT_EQ(followed_from(search, a, b, {truth[contact]}), expected) << objects[i].first;
      several += expected.size() < truth.size() ? 1 : 0;
    }
  }
  EXPECT_GT(several, 3U) << "of several curves only that of the contact";
}

TEST(Followed_contacts, go_on_through_vertices_and_along_edges_and_end_at_open_borders) {
  Opening_search search;
  const auto expect_all = [&](const Face_soup& one, const Face_soup& other) {
    Followed_object a(one, 4), b(other, 4);
    const auto truth = true_contacts(a, b);
    ASSERT_FALSE(truth.empty());
    for (const Face_pair contact : truth) EXPECT_EQ(followed_from(search, a, b, {contact}), truth);
  };
  // The plane z = 0 contains the equator of the sphere: vertices and edges.
  Face_soup plane;
  plane.coordinates = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
  plane.faces = {{0, 1, 2}, {0, 2, 3}};
  expect_all(sphere(8), plane);
  expect_all(moved(cube(4), -0.5, -0.5, -0.5), plane);
  auto upright = grid(7, 7);
  deform(upright, [](const Point& p) { return Point(p.x() + 0.3, 2.4, p.y() - 3.2); });
  expect_all(grid(9, 6), upright);
}

TEST(Followed_contacts, cross_seams_that_are_closed_and_stop_at_open_ones) {
  Opening_search search;
  const Face_soup apart = flat_shaded(sphere(8));
  Followed_object closed(apart, 4, true), open(apart, 4), other(moved(sphere(7), 1.3, 0.2, 0.1), 96);
  const auto truth = true_contacts(closed, other);
  EXPECT_EQ(followed_from(search, closed, other, {truth.front()}), truth);
  const auto found = followed_from(search, open, other, {truth.front()});
  EXPECT_LT(found.size(), truth.size());
  EXPECT_EQ(found, reached_from(open, other, truth, truth.front()));
}

TEST(Followed_contacts, complete_what_a_search_has_left) {
  Opening_search search;
  Followed_object a(icosphere(20)), b(moved(icosphere(20), 0.9, 0.2, 0.1));
  const auto truth = true_contacts(a, b);
  std::size_t completed = 0;
  for (const std::size_t budget : {50, 100, 200, 400, 1000, 100'000}) {
    a.start_frame(), b.start_frame();
    search.begin(a.tree(), b.tree(), {.all = true, .budget = budget}, root_start);
    std::vector<Face_pair> opened, found;
    search.open(opened);
    if (opened.empty()) continue;
    const std::vector<Leaf_pair> compared(search.compared().begin(), search.compared().end());
    EXPECT_TRUE(are_unique(compared));
    const std::size_t tests = search.leaf_tests();
    EXPECT_EQ(compared.size(), tests);
    search.begin(a.tree(), b.tree(), {.all = true});
    search.follow(a.neighbours(), b.neighbours(), {.contacts = opened, .compared = compared}, found);
    std::ranges::sort(found);
    EXPECT_EQ(found, truth);
    completed += opened.size() < truth.size() ? 1 : 0;
    if (budget == 100'000) {
      EXPECT_EQ(search.leaf_tests(), 0U) << "leaves that have been compared are not compared again";
    }
  }
  EXPECT_GT(completed, 1U);
}

/// A sphere, and a long plate that passes through it: two curves, of which one contact of one is known.
class Followed_contacts_of_two_curves : public testing::Test {
 protected:
  struct Searched {
    std::vector<Face_pair> found;
    std::size_t followed = 0;  ///< vertices that were read to follow
    std::size_t read = 0;      ///< all
  };

  static Face_soup plate() {
    Face_soup plate = grid(60, 20);
    deform(plate, [](const Point& p) { return Point(0.1 * p.x() - 2.9, 0.02 * p.y() - 0.2, 0.01); });
    return plate;
  }

  std::size_t read() { return a_.tree().vertices_read() + b_.tree().vertices_read(); }

  /// Follows, then opens with the rest of a budget.
  Searched search(std::size_t budget, const std::vector<Face_pair>& contacts) {
    a_.start_frame(), b_.start_frame();
    search_.begin(a_.tree(), b_.tree(), {.all = true, .budget = budget}, root_start);
    Searched searched;
    search_.follow(a_.neighbours(), b_.neighbours(), {.contacts = contacts}, searched.found);
    searched.followed = read();
    search_.open(searched.found);
    searched.read = read();
    std::ranges::sort(searched.found);
    EXPECT_TRUE(std::ranges::includes(truth_, searched.found));
    EXPECT_EQ(std::ranges::adjacent_find(searched.found), searched.found.end()) << "no leaf pair is compared twice";
    EXPECT_TRUE(are_unique({search_.compared().begin(), search_.compared().end()}));
    return searched;
  }

  static constexpr std::size_t two_leaves = 80;  ///< more vertices than two leaves have

  Opening_search search_;
  Followed_object a_{icosphere(20)}, b_{plate()};
  const std::vector<Face_pair> truth_ = true_contacts(a_, b_);
  const std::vector<Face_pair> known_{truth_.front()};
};

TEST_F(Followed_contacts_of_two_curves, are_not_compared_again_by_openings) {
  EXPECT_EQ(search(100'000, {}).found, truth_);
  EXPECT_EQ(search(100'000, known_).found, truth_);
  EXPECT_FALSE(search_.is_limited());
}

TEST_F(Followed_contacts_of_two_curves, count_towards_the_budget_of_openings) {
  const std::size_t followed = search(1, known_).followed, budget = 3 * followed;
  const auto searched = search(budget, known_);
  EXPECT_TRUE(search_.is_limited());
  EXPECT_TRUE(search_.out_of_budget());
  EXPECT_EQ(searched.followed, followed);
  EXPECT_GE(search_.spent(), budget);
  EXPECT_LE(search_.spent(), budget + two_leaves);
  EXPECT_LE(searched.read, search_.spent()) << "pairs of nodes count too";
}

TEST_F(Followed_contacts_of_two_curves, leave_half_of_the_budget_to_openings) {
  const std::size_t followed = search(1, known_).followed, budget = followed;
  const auto searched = search(budget, known_);
  EXPECT_TRUE(search_.out_of_budget());
  EXPECT_GE(search_.spent(), followed + budget / 2);
  EXPECT_LE(search_.spent(), followed + budget / 2 + two_leaves);
  EXPECT_LE(searched.read, search_.spent()) << "pairs of nodes count too";
}

TEST_F(Followed_contacts_of_two_curves, are_not_followed_again_where_they_have_been) {
  a_.start_frame(), b_.start_frame();
  search_.begin(a_.tree(), b_.tree(), {.all = true});
  std::vector<Face_pair> curve;
  search_.follow(a_.neighbours(), b_.neighbours(), {.contacts = known_}, curve);
  ASSERT_LT(curve.size(), truth_.size()) << "one of two curves";
  const std::vector<Leaf_pair> compared(search_.compared().begin(), search_.compared().end());
  const auto of_other_curve =
      std::ranges::find_if(truth_, [&](Face_pair contact) { return std::ranges::find(curve, contact) == curve.end(); });
  std::vector<Face_pair> contacts = curve;
  contacts.push_back(*of_other_curve);
  const auto follow_on = [&](std::span<const Leaf_pair> known, std::size_t followed) {
    search_.begin(a_.tree(), b_.tree(), {.all = true});
    std::vector<Face_pair> found;
    search_.follow(a_.neighbours(), b_.neighbours(), {contacts, known, followed}, found);
    std::ranges::sort(found);
    return found;
  };
  EXPECT_EQ(follow_on(compared, curve.size()), truth_) << "the other curve is followed";
  EXPECT_EQ(follow_on(compared, 0), truth_);
  // The rest of its curve is not found where `followed` covers a contact beside which nothing was compared.
  contacts = known_;
  const Leaf_pair at{a_.neighbours().leaf_of(known_[0].a), b_.neighbours().leaf_of(known_[0].b)};
  EXPECT_EQ(follow_on({&at, 1}, 1), known_);
  EXPECT_EQ(search_.leaf_tests(), 0U);
  EXPECT_GT(follow_on({&at, 1}, 0).size(), 1U);
}

TEST(Followed_contacts, of_starts_that_were_opened_as_a_whole_are_compared_only_beyond_them) {
  Followed_object a(icosphere(20)), b(moved(icosphere(20), 0.9, 0.2, 0.1));
  const auto truth = true_contacts(a, b);
  const auto children = [](Followed_object& object) {
    return std::array{1U, object.tree().layout().node(0).second_child};
  };
  Opening_search search;
  std::size_t all_tests = 0;
  // All halves with all others, then some with some: the others are not covered, though their leaves are read.
  for (const std::size_t count : {4, 3, 2, 1}) {
    std::vector<Opening_start> starts;
    for (const auto half_a : children(a))
      for (const auto half_b : children(b))
        if (starts.size() < count) starts.push_back({{half_a, half_b}, 0});
    a.start_frame(), b.start_frame();
    search.begin(a.tree(), b.tree(), {.all = true, .most_whole = 100'000}, starts);
    std::vector<Face_pair> opened, found;
    search.open(opened);
    const std::size_t leaf_tests = search.leaf_tests();
    ASSERT_FALSE(opened.empty());
    ASSERT_LE(opened.size(), truth.size());
    search.begin(a.tree(), b.tree(), {.all = true, .most_whole = 100'000, .opened = true}, starts);
    search.follow(a.neighbours(), b.neighbours(), {.contacts = opened}, found);
    std::ranges::sort(found);
    EXPECT_EQ(found, truth) << count;
    const std::size_t beyond = search.leaf_tests();
    EXPECT_EQ(beyond == 0, count == 4) << count;
    if (count == 4) all_tests = leaf_tests;
    EXPECT_LE(leaf_tests + beyond, all_tests) << "no leaf pair is compared twice";
  }
}

TEST(Followed_contacts, lead_to_what_has_been_stretched_beyond_its_radii) {
  // A plate, of which one end has been pulled out to ten times its length. Another plate cuts it along.
  const Face_soup rest = grid(40, 4);
  Face_soup pulled = rest;
  for (std::size_t v = 0; v < pulled.vertex_count(); ++v)
    if (double& x = pulled.coordinates[3 * v]; x > 20) x = 20 + 10 * (x - 20);
  Face_soup blade = grid(201, 2);
  for (std::size_t v = 0; v < blade.vertex_count(); ++v) {
    double* const p = &blade.coordinates[3 * v];
    std::tie(p[0], p[1], p[2]) = std::tuple(1.1 * p[0], 1.7 + 0.001 * p[0], p[1] - 0.5);
  }
  Followed_object a(rest, pulled, 4, false), b(blade);
  const auto truth = true_contacts(a, b);
  Opening_search search;
  a.start_frame(), b.start_frame();
  search.begin(a.tree(), b.tree(), {.all = true, .budget = 100'000}, root_start);
  std::vector<Face_pair> opened;
  search.open(opened);
  ASSERT_FALSE(opened.empty());
  ASSERT_LT(opened.size(), truth.size());
  EXPECT_EQ(followed_from(search, a, b, opened), truth);
}

TEST(Followed_contacts, are_the_same_in_the_same_order_for_any_number_of_workers) {
  Followed_object a(icosphere(40), 16), b(moved(icosphere(40), 0.9, 0.2, 0.1), 16);
  const auto truth = true_contacts(a, b);
  std::vector<Face_pair> alone, some;
  for (std::size_t i = 0; i < truth.size(); i += 5) some.push_back(truth[i]);
  for (const std::size_t threads : {1, 2, 5}) {
    Workers workers(threads);
    Opening_search search;
    a.start_frame(), b.start_frame();
    search.begin(a.tree(), b.tree(), {.all = true});
    std::vector<Face_pair> found;
    search.follow(a.neighbours(), b.neighbours(), {.contacts = some}, found, workers);
    EXPECT_GT(search.leaf_tests(), 100U) << "enough for all workers";
    if (alone.empty()) alone = found;
    EXPECT_EQ(found, alone);
    std::ranges::sort(found);
    EXPECT_EQ(found, truth);
  }
}

TEST(Followed_contacts, a_coordinate_that_is_not_finite_is_refused) {
  Followed_object a(sphere(12)), b(moved(sphere(10), 1.3, 0.2, 0.1));
  const auto truth = true_contacts(a, b);
  const auto far = std::ranges::find_if(
      truth, [&](Face_pair pair) { return a.neighbours().leaf_of(pair.a) != a.neighbours().leaf_of(truth.front().a); });
  ASSERT_NE(far, truth.end());
  for (const auto corner : a.surface().soup().faces[far->a]) a.surface().coordinates()[3 * corner] = not_a_number;
  Opening_search search;
  a.start_frame(), b.start_frame();
  search.begin(a.tree(), b.tree(), {.all = true});
  std::vector<Face_pair> found;
  EXPECT_THROW(search.follow(a.neighbours(), b.neighbours(), {.contacts = {&truth.front(), 1}}, found), Bad_mesh);
}

TEST(Followed_contacts, leave_nothing_to_the_next_search_where_a_coordinate_was_not_finite) {
  Followed_object a(sphere(12)), b(moved(sphere(10), 1.3, 0.2, 0.1));
  const auto truth = true_contacts(a, b);
  const std::vector<double> finite = a.surface().coordinates();
  Opening_search search;
  std::size_t refused = 0;
  for (const auto& corners : a.surface().soup().faces) {
    for (const auto corner : corners) a.surface().coordinates()[3 * corner] = not_a_number;
    a.start_frame(), b.start_frame();
    search.begin(a.tree(), b.tree(), {.all = true});
    std::vector<Face_pair> found;
    try {
      search.follow(a.neighbours(), b.neighbours(), {.contacts = {&truth.front(), 1}}, found);
    } catch (const Bad_mesh&) {
      ++refused;
    }
    a.surface().coordinates() = finite;
    EXPECT_TRUE(followed_from(search, a, b, {}).empty());
    EXPECT_TRUE(search.compared().empty());
  }
  EXPECT_GT(refused, 10U);
}

}  // namespace
}  // namespace lodestone
