// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/opening_search.h"

#include <gtest/gtest.h>

#include "lodestone/tree/region_anchors.h"
#include "support/face_soup.h"

namespace lodestone {
namespace {

constexpr std::size_t large_budget = 100'000'000;

/// An object that is read on demand. Not movable, since the tree refers to its positions.
class Opened_object {
 public:
  explicit Opened_object(const Face_soup& rest, std::size_t leaf_faces = 8)
      : rest_(rest),
        now_(rest),
        labels_(octants(rest)),
        tree_(rest.faces, labels_, rest.coordinates, {.leaf_faces = leaf_faces}) {
    tree_.start_frame(Live_positions(rest_.coordinates.data()));
    regions_ = Region_anchors(tree_, rest_.faces, labels_, rest_.coordinates);
  }
  Opened_object(const Opened_object&) = delete;
  Opened_object& operator=(const Opened_object&) = delete;

  void move_to(const Face_soup& now) {
    now_ = now;
    start_frame();
  }
  /// Forgets what was read, and learns how far the object is stretched.
  void start_frame() {
    tree_.start_frame(Live_positions(now_.coordinates.data()));
    regions_.read(tree_, 1);
  }
  const Face_soup& rest() const { return rest_; }
  const Face_soup& now() const { return now_; }
  const Region_anchors& regions() const { return regions_; }
  Tree_on_demand& tree() { return tree_; }

 private:
  Face_soup rest_, now_;
  std::vector<Region_index> labels_;
  Tree_on_demand tree_;
  Region_anchors regions_;
};

struct Opened {
  std::vector<Face_pair> found;  ///< sorted
  bool out_of_budget = false;
  std::size_t leaf_tests = 0, exact_tests = 0, vertices_read = 0, spent = 0;
};

const std::vector<Opening_start> from_roots{{{0, 0}, 0}};

std::vector<Opening_start> near_starts(const Opened_object& a, const Opened_object& b) {
  std::vector<Near_regions> near;
  list_near_regions(a.regions(), b.regions(), near);
  std::vector<Opening_start> starts;
  for (const auto& pair : near) starts.push_back({{a.regions().node(pair.a), b.regions().node(pair.b)}, pair.order});
  return starts;
}

/// Whether a node is another one, or lies below it.
bool is_below(const Tree_layout& layout, std::uint32_t node, std::uint32_t above) {
  if (node == above) return true;
  return !layout.is_leaf(above) &&
         (is_below(layout, node, above + 1) || is_below(layout, node, layout.node(above).second_child));
}

/// Searches below the roots, or below the regions that may touch, in a new frame.
Opened opened(Opening_search& search, Opened_object& a, Opened_object& b, const Opening_request& request,
              bool from_regions = false) {
  a.start_frame(), b.start_frame();
  const std::size_t before = a.tree().vertices_read() + b.tree().vertices_read();
  search.begin(a.tree(), b.tree(), request, from_regions ? near_starts(a, b) : from_roots);
  Opened result;
  const bool some = search.open(result.found);
  EXPECT_EQ(some, !result.found.empty());
  std::ranges::sort(result.found);
  EXPECT_EQ(std::ranges::adjacent_find(result.found), result.found.end());
  result.out_of_budget = search.out_of_budget();
  result.leaf_tests = search.leaf_tests();
  result.exact_tests = search.exact_tests();
  result.vertices_read = a.tree().vertices_read() + b.tree().vertices_read() - before;
  result.spent = search.spent();
  EXPECT_GE(result.spent, result.vertices_read);
  return result;
}

/// Checks all queries with a large budget.
void expect_opened(Opening_search& search, Opened_object& a, Opened_object& b) {
  const auto truth = true_pairs(a.now(), b.now());
  for (const auto& [from_regions, most_whole] :
       {std::pair{false, 0UL}, std::pair{true, 0UL}, std::pair{false, large_budget}, std::pair{true, large_budget}}) {
    const auto all =
        opened(search, a, b, {.all = true, .budget = large_budget, .most_whole = most_whole}, from_regions);
    EXPECT_EQ(all.found, truth);
    EXPECT_FALSE(all.out_of_budget);
    EXPECT_GE(all.exact_tests, truth.size());
    const auto first = opened(search, a, b, {.budget = large_budget, .most_whole = most_whole}, from_regions);
    EXPECT_EQ(first.found.size(), std::min<std::size_t>(1, truth.size()));
    EXPECT_TRUE(std::ranges::includes(truth, first.found));
    const auto by_openings = opened(search, a, b, {.all = true, .budget = large_budget}, from_regions);
    EXPECT_LE(first.leaf_tests, all.leaf_tests + (most_whole > 0 ? by_openings.leaf_tests : 0));
  }
}

/// Two triangles without area on one line, which have one end in common.
std::pair<Face_soup, Face_soup> needles_end_to_end(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] {
    const double x = unit(random), y = unit(random), z = unit(random);
    return Eigen::Vector3d(x, y, z);
  };
  const Eigen::Vector3d end = vector(), along = vector();
  const auto needle = [&](double length) {
    Face_soup soup;
    for (const double t : {0.0, 0.5, 1.0}) {
      const Eigen::Vector3d p = end + t * length * along;
      soup.coordinates.insert(soup.coordinates.end(), p.begin(), p.end());
    }
    soup.faces = {{0, 1, 2}};
    return soup;
  };
  return {needle(1), needle(-0.7)};
}

TEST(Opening_search, with_a_large_budget_finds_what_exhaustive_checking_does) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  Opening_search search;
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (std::size_t j = 0; j < objects.size(); ++j) {
      SCOPED_TRACE(objects[i].first + " and " + objects[j].first);
      Opened_object a(objects[i].second), b(objects[j].second, 30);
      for (const double factor : {1.0, 3.0, 0.4}) {
        a.move_to(placed(posed_at_random(a.rest(), 0.8, random), factor));
        b.move_to(placed(posed_at_random(b.rest(), 0.8, random), factor));
        expect_opened(search, a, b);
      }
    }
}

TEST(Opening_search, far_from_the_origin_finds_the_same) {
  std::mt19937_64 random(2);
  Opening_search search;
  Opened_object a(icosphere(6)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  for (const double offset : {1e6, -1e9}) {
    a.move_to(placed(posed_at_random(a.rest(), 0.5, random), 1, offset));
    b.move_to(placed(posed_at_random(b.rest(), 0.5, random), 1, offset));
    expect_opened(search, a, b);
  }
}

TEST(Opening_search, distances_that_overflow_put_nothing_in_order) {
  std::mt19937_64 random(5);
  Opening_search search;
  Opened_object a(icosphere(6)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  a.move_to(placed(posed_at_random(a.rest(), 0.5, random), 1e200));
  b.move_to(placed(posed_at_random(b.rest(), 0.5, random), 1e200));
  expect_opened(search, a, b);
  const auto truth = true_pairs(a.now(), b.now());
  ASSERT_FALSE(truth.empty());
  const auto some = opened(search, a, b, {.all = true, .budget = 300}, true);
  EXPECT_TRUE(std::ranges::includes(truth, some.found));
}

TEST(Opening_search, faces_that_touch_or_have_no_area_are_found_too) {
  Opening_search search;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 1; seed < 30; ++seed) {
    Opened_object a(lattice_soup(60, 40, 5, seed), 4), b(moved(lattice_soup(60, 40, 5, seed + 100), 3, 1, 0), 4);
    expect_opened(search, a, b);
    contacts += true_pairs(a.now(), b.now()).size();
  }
  EXPECT_GT(contacts, 1000U);
}

TEST(Opening_search, surfaces_that_only_touch_where_their_radii_end_are_found) {
  std::mt19937_64 random(3);
  Opening_search search;
  for (int i = 0; i < 300; ++i) {
    const auto [one, other] = needles_end_to_end(random);
    Opened_object a(one), b(other);
    if (true_pairs(a.now(), b.now()).empty()) continue;
    expect_opened(search, a, b);
  }
}

TEST(Opening_search, a_contact_found_with_a_small_budget_is_true_and_the_search_says_that_it_was_cut_off) {
  std::mt19937_64 random(4);
  const auto objects = small_objects();
  Opening_search search;
  std::size_t cut_off = 0, complete = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Opened_object a(objects[i].second), b(objects[(i + 1) % objects.size()].second);
    for (int pose = 0; pose < 4; ++pose) {
      a.move_to(posed_at_random(a.rest(), 1.5, random)), b.move_to(posed_at_random(b.rest(), 1.5, random));
      const auto truth = true_pairs(a.now(), b.now());
      for (const std::size_t budget : {1, 5, 20, 60, 100, 200, 300})
        for (const double reach : {0.5, 1.0})
          for (const bool all : {false, true}) {
            const auto some = opened(search, a, b, {.all = all, .reach = reach, .budget = budget}, pose % 2 == 0);
            EXPECT_TRUE(std::ranges::includes(truth, some.found));
            if (some.out_of_budget) {
              EXPECT_GE(some.spent, budget);
              ++cut_off;
            } else if (reach == 1) {
              EXPECT_EQ(some.found.size(), all ? truth.size() : std::min<std::size_t>(1, truth.size()));
              ++complete;
            }
          }
    }
  }
  EXPECT_GT(cut_off, 50U);
  EXPECT_GT(complete, 20U);
}

TEST(Opening_search, without_a_budget_finds_nothing_and_says_so) {
  Opening_search search;
  Opened_object a(icosphere(6)), b(icosphere(5));
  b.move_to(moved(b.rest(), 0.5, 0, 0));
  for (const bool all : {false, true}) {
    const auto none = opened(search, a, b, {.all = all, .budget = 0});
    EXPECT_TRUE(none.found.empty());
    EXPECT_TRUE(none.out_of_budget);
    EXPECT_EQ(none.leaf_tests + none.exact_tests + none.vertices_read, 0U);
  }
  EXPECT_FALSE(opened(search, a, b, {.budget = large_budget}).out_of_budget) << "of the last search only";
}

TEST(Opening_search, the_faces_of_two_leaves_are_compared_exactly) {
  Opening_search search;
  Opened_object a(icosphere(6)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  const auto truth = true_pairs(a.now(), b.now());
  const Tree_layout &layout_a = a.tree().layout(), &layout_b = b.tree().layout();
  std::vector<Face_pair> together;
  for (const bool all : {false, true})
    for (std::uint32_t leaf_a = 0; leaf_a < layout_a.leaf_count(); ++leaf_a)
      for (std::uint32_t leaf_b = 0; leaf_b < layout_b.leaf_count(); ++leaf_b) {
        const Opening_start start{{layout_a.leaf_node(leaf_a), layout_b.leaf_node(leaf_b)}, 0};
        search.begin(a.tree(), b.tree(), {.all = all, .budget = large_budget}, std::span(&start, 1));
        std::vector<Face_pair> found;
        const bool some = search.open(found);
        EXPECT_EQ(some, !found.empty());
        const auto expected = static_cast<std::size_t>(std::ranges::count_if(truth, [&](Face_pair pair) {
          return std::ranges::find(layout_a.faces(leaf_a), pair.a) != layout_a.faces(leaf_a).end() &&
                 std::ranges::find(layout_b.faces(leaf_b), pair.b) != layout_b.faces(leaf_b).end();
        }));
        EXPECT_EQ(found.size(), all ? expected : std::min<std::size_t>(1, expected));
        if (all) together.insert(together.end(), found.begin(), found.end());
      }
  std::ranges::sort(together);
  EXPECT_EQ(together, truth);
}

TEST(Opening_search, workers_find_the_same_in_the_same_order) {
  Opened_object a(icosphere(40)), b(icosphere(40));
  b.move_to(moved(b.rest(), 0.7, 0.01, 0.02));
  std::vector<Face_pair> alone;
  std::size_t exact_tests = 0, vertices_read = 0;
  for (const std::size_t threads : {1, 2, 5}) {
    Workers workers(threads);
    Opening_search search;
    for (int again = 0; again < 3; ++again) {
      a.start_frame(), b.start_frame();
      search.begin(a.tree(), b.tree(), {.all = true, .budget = 4000}, from_roots);
      std::vector<Face_pair> found;
      search.open(found, workers);
      if (alone.empty()) {
        alone = found;
        exact_tests = search.exact_tests();
        vertices_read = a.tree().vertices_read() + b.tree().vertices_read();
        ASSERT_GT(search.leaf_tests(), 100U) << "enough for all workers";
        ASSERT_FALSE(alone.empty());
      }
      EXPECT_EQ(found, alone);
      EXPECT_EQ(search.exact_tests(), exact_tests);
      EXPECT_EQ(a.tree().vertices_read() + b.tree().vertices_read(), vertices_read);
    }
  }
}

TEST(Opening_search, reads_regions_as_a_whole_up_to_a_number_of_vertices) {
  Opening_search search;
  Opened_object a(icosphere(12)), b(icosphere(12));
  b.move_to(moved(b.rest(), 1.9, 0.01, 0.02));
  const auto vertices_near = [&] {
    std::set<std::uint32_t> nodes_a, nodes_b;
    for (const auto& start : near_starts(a, b)) nodes_a.insert(start.nodes.a), nodes_b.insert(start.nodes.b);
    std::size_t vertices = 0;
    for (const auto& [nodes, layout] :
         {std::pair(&nodes_a, &a.tree().layout()), std::pair(&nodes_b, &b.tree().layout())})
      for (const auto node : *nodes)
        for (std::uint32_t leaf = 0; leaf < layout->leaf_count(); ++leaf)
          if (is_below(*layout, layout->leaf_node(leaf), node)) vertices += layout->vertices(leaf).size();
    return vertices;
  };
  a.start_frame(), b.start_frame();
  const std::size_t vertices = vertices_near();
  ASSERT_GT(vertices, 100U);
  ASSERT_LT(vertices, a.tree().layout().vertex_begin().back() + b.tree().layout().vertex_begin().back())
      << "far regions are left out";
  const auto truth = true_pairs(a.now(), b.now());
  ASSERT_FALSE(truth.empty());

  const auto whole = opened(search, a, b, {.all = true, .budget = 10, .most_whole = vertices}, true);
  EXPECT_FALSE(search.is_limited());
  EXPECT_FALSE(whole.out_of_budget);
  EXPECT_EQ(whole.found, truth);
  const std::size_t roots = 2;  // whose anchors tell the bounds
  EXPECT_EQ(whole.vertices_read, vertices + roots) << "each leaf once";
  const auto first = opened(search, a, b, {.budget = 10, .most_whole = vertices}, true);
  EXPECT_EQ(first.found.size(), 1U);
  EXPECT_FALSE(first.out_of_budget);
  EXPECT_GE(first.vertices_read, vertices + roots) << "after openings have read ten";
  EXPECT_LE(first.vertices_read, vertices + roots + 12);

  const auto some = opened(search, a, b, {.all = true, .budget = 10, .most_whole = vertices - 1}, true);
  EXPECT_TRUE(search.is_limited());
  EXPECT_TRUE(some.out_of_budget);
  EXPECT_LT(some.vertices_read, vertices);
}

TEST(Opening_search, regions_read_as_a_whole_are_searched_whatever_their_stretch) {
  // One end of a plate has been pulled out to ten times its length; another plate cuts it along.
  Face_soup pulled = grid(40, 4), blade = grid(201, 2);
  for (std::size_t v = 0; v < blade.vertex_count(); ++v) {
    double* const p = &blade.coordinates[3 * v];
    std::tie(p[0], p[1], p[2]) = std::tuple(1.1 * p[0], 1.7 + 0.001 * p[0], p[1] - 0.5);
  }
  Opened_object a(pulled, 4), b(blade);
  for (std::size_t v = 0; v < pulled.vertex_count(); ++v)
    if (double& x = pulled.coordinates[3 * v]; x > 20) x = 20 + 10 * (x - 20);
  a.move_to(pulled), b.move_to(blade);
  Opening_search search;
  const auto truth = true_pairs(a.now(), b.now());
  const auto by_anchors = opened(search, a, b, {.all = true, .budget = large_budget});
  EXPECT_LT(by_anchors.found.size(), truth.size());
  const auto whole = opened(search, a, b, {.all = true, .most_whole = large_budget});
  EXPECT_EQ(whole.found, truth);
}

TEST(Opening_search, one_contact_is_searched_for_as_a_whole_once_openings_have_read_a_share) {
  // A sphere in another one, all of it near, which is dented in one place.
  Face_soup dented = icosphere(40);
  for (std::size_t v = 0; v < dented.vertex_count(); ++v) {
    double* const p = &dented.coordinates[3 * v];
    const double factor = p[0] > 0.99 ? 1.05 : 1.01;
    for (int axis = 0; axis < 3; ++axis) p[axis] *= factor * (p[0] < -0.998 && axis == 0 ? 0.97 : 1);
  }
  Opened_object a(icosphere(40)), b(dented);
  const std::size_t vertices = a.rest().vertex_count() + b.rest().vertex_count();
  const auto truth = true_pairs(a.now(), b.now());
  ASSERT_FALSE(truth.empty());
  Opening_search search;
  const auto by_openings = opened(search, a, b, {.budget = vertices / 8});
  EXPECT_TRUE(by_openings.out_of_budget) << "as many do not suffice";
  const auto as_a_whole = opened(search, a, b, {.budget = vertices / 8, .most_whole = large_budget});
  EXPECT_EQ(as_a_whole.found.size(), 1U);
  EXPECT_FALSE(as_a_whole.out_of_budget);
  // With any budget no more than a share is spent on openings, here on surfaces that do not meet.
  b.move_to(placed(icosphere(40), 1.01));
  const auto none = opened(search, a, b, {.budget = large_budget, .most_whole = large_budget});
  EXPECT_TRUE(none.found.empty());
  EXPECT_FALSE(none.out_of_budget);
  EXPECT_LE(none.leaf_tests, 2 * opened(search, a, b, {.budget = large_budget}).leaf_tests) << "none is tested twice";
}

/// A box whose faces are as large as its sides.
Face_soup room(double size) {
  Face_soup soup;
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      soup.coordinates.push_back((corner >> axis & 1U) == 0 ? -size / 2 : size / 2);
  soup.faces = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return soup;
}

TEST(Opening_search, a_finely_divided_body_that_touches_a_huge_wall_is_found_and_little_of_it_is_read) {
  Opened_object ball(icosphere(60), 32), walls(room(40), 32);
  const std::size_t vertices = ball.rest().vertex_count();
  Opening_search search;
  for (const bool swapped : {false, true})
    for (const double x : {18.5, 18.99, 19.001}) {  // the wall is at 20
      ball.move_to(moved(ball.rest(), x, 3.1, -5.2));
      walls.start_frame();
      Opened_object &a = swapped ? walls : ball, &b = swapped ? ball : walls;
      const auto truth = true_pairs(a.now(), b.now());
      EXPECT_EQ(truth.empty(), x < 19);
      for (const bool all : {false, true}) {
        const auto found = opened(search, a, b, {.all = all, .budget = vertices / 4}, true);
        EXPECT_EQ(found.found.size(), all ? truth.size() : std::min<std::size_t>(truth.size(), 1)) << x;
        EXPECT_FALSE(found.out_of_budget) << x;
        EXPECT_LT(found.vertices_read, vertices / 10) << x;
      }
    }
}

TEST(Opening_search, a_larger_reach_does_not_hide_what_a_smaller_one_finds) {
  Opened_object a(icosphere(60), 32), b(icosphere(60), 32);
  b.move_to(moved(b.rest(), 1.998, 0.01, 0.02));
  Opening_search search;
  for (const double reach : {1.0, 1.5, 2.0, 4.0, 8.0, 16.0, 32.0})
    EXPECT_EQ(opened(search, a, b, {.reach = reach, .budget = 2000}).found.size(), 1U) << reach;
}

TEST(Opening_search, a_reach_whose_square_overflows_drops_nothing_in_silence) {
  Opened_object ball(icosphere(60), 32), walls(room(40), 32);
  ball.move_to(moved(ball.rest(), 19.001, 3.1, -5.2));
  walls.start_frame();
  Opening_search search;
  for (const double reach : {1e100, 1e155, 1e200, 1e308}) {
    const auto found = opened(search, ball, walls, {.reach = reach, .budget = 2000}, true);
    EXPECT_TRUE(!found.found.empty() || found.out_of_budget) << reach;
  }
}

/// Needles side by side, along x.
Face_soup needles(std::uint32_t count, double y_step) {
  Face_soup soup;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const double x : {-50.0, 50.0, 50.0})
      soup.coordinates.insert(soup.coordinates.end(), {x, y_step * i, 0.001 * static_cast<double>(i % 3) + 0.001 * x});
    soup.coordinates[soup.coordinates.size() - 2] += 0.1 * y_step;
    soup.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

TEST(Opening_search, pairs_of_nodes_count_against_the_budget) {
  const Face_soup along = needles(400, 0.2);
  Face_soup across = needles(400, 0.2);
  for (std::size_t v = 0; v < across.vertex_count(); ++v) {
    double* const p = &across.coordinates[3 * v];
    std::tie(p[0], p[1], p[2]) = std::tuple(p[1] - 40, p[0] + 40, p[2] + 0.5);
  }
  Opened_object a(along, 2), b(across, 2);
  ASSERT_TRUE(true_pairs(a.now(), b.now()).empty());
  Opening_search search;
  const std::size_t vertices = a.rest().vertex_count() + b.rest().vertex_count();
  const auto found = opened(search, a, b, {.all = true, .budget = vertices - 1});
  EXPECT_TRUE(found.out_of_budget) << "400 x 400 needles are near each other";
  EXPECT_LT(found.vertices_read, vertices - 1);
  EXPECT_GE(found.spent, vertices - 1);
}

TEST(Opening_search, surfaces_that_meet_in_a_small_place_are_read_only_around_it) {
  Opening_search search;
  Opened_object a(icosphere(60), 96), b(icosphere(60), 96);
  b.move_to(moved(b.rest(), 1.999, 0.01, 0.02));
  ASSERT_FALSE(true_pairs(a.now(), b.now()).empty());
  const auto found = opened(search, a, b, {.all = true, .budget = large_budget});
  EXPECT_LT(found.vertices_read, (a.rest().vertex_count() + b.rest().vertex_count()) / 10);
}

TEST(Opening_search, what_was_read_before_it_begins_does_not_count_against_the_budget) {
  Opened_object a(icosphere(32)), b(moved(icosphere(32), 1.99, 0.02, 0));
  Opening_search search;
  std::size_t enough = 64;
  const auto request = [&] { return Opening_request{.all = true, .budget = enough}; };
  while (opened(search, a, b, request()).out_of_budget) enough += enough / 16;
  const auto truth = opened(search, a, b, request()).found;
  ASSERT_FALSE(truth.empty());
  ASSERT_LT(enough, a.tree().vertex_count());
  // As for another pair of the same frame.
  a.start_frame(), b.start_frame();
  a.tree().pose_below(0);
  search.begin(a.tree(), b.tree(), request(), from_roots);
  EXPECT_EQ(search.spent(), 0U);
  std::vector<Face_pair> found;
  search.open(found);
  std::ranges::sort(found);
  EXPECT_EQ(found, truth);
  EXPECT_FALSE(search.out_of_budget());
}

TEST(Opening_starts, cover_no_leaves_that_only_earlier_starts_covered) {
  Opened_object one(icosphere(4)), large(icosphere(12)), small(icosphere(6));
  const Tree_layout &a = one.tree().layout(), &b = large.tree().layout(), &c = small.tree().layout();
  const std::vector<Opening_start> first_halves{{{1, 1}, 0}};
  const std::uint32_t half = c.node(1).end_leaf;
  ASSERT_LE(c.leaf_count(), b.node(1).end_leaf);
  Opening_starts starts;
  for (const bool turned : {false, true}) {
    const auto begin = [&](const Tree_layout& other) {
      turned ? starts.begin(other, a, first_halves, large_budget) : starts.begin(a, other, first_halves, large_budget);
    };
    const auto covers = [&](std::uint32_t leaf) {
      return starts.cover(turned ? Leaf_pair{leaf, 0} : Leaf_pair{0, leaf});
    };
    begin(b);
    for (std::uint32_t leaf = 0; leaf < c.leaf_count(); ++leaf) EXPECT_TRUE(covers(leaf));
    begin(c);
    for (std::uint32_t leaf = 0; leaf < c.leaf_count(); ++leaf) EXPECT_EQ(covers(leaf), leaf < half) << leaf;
  }
}

}  // namespace
}  // namespace lodestone
