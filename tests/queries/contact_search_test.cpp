// SPDX-License-Identifier: GPL-3.0-or-later
// Searches between two objects; `contact_search_within_test.cpp` has those within one.
#include "lodestone/queries/contact_search.h"

#include <gtest/gtest.h>

#include "lodestone/triangles/triangle_distance.h"
#include "queries/searches.h"

namespace lodestone {
namespace {

TEST(Contact_search, equals_exhaustive_checking_in_any_pose) {
  std::mt19937_64 random(1);
  std::size_t poses = 0, meeting = 0;
  const auto objects = small_objects();
  for (const std::size_t leaf_faces : {2, 9, 64, 128})
    for (std::size_t i = 0; i < objects.size(); ++i)
      for (std::size_t j = i; j < objects.size(); ++j) {
        SCOPED_TRACE(objects[i].first + " and " + objects[j].first + ", " + std::to_string(leaf_faces));
        Posed_object a(objects[i].second, leaf_faces), b(objects[j].second, leaf_faces, false);
        for (int pose = 0; pose < 4; ++pose) {
          a.move_to(posed_at_random(objects[i].second, 0.7, random));
          b.move_to(posed_at_random(objects[j].second, 0.7, random));
          const auto truth = true_pairs(a.soup(), b.soup());
          expect_answers(truth, 0, [&](const Contact_request& request) { return search_between(a, b, request); });
          ++poses, meeting += truth.empty() ? 0 : 1;
        }
      }
  EXPECT_GT(meeting, poses / 2);
  EXPECT_LT(meeting, poses);
}

TEST(Contact_search, equals_exhaustive_checking_of_shapes_that_touch_or_coincide) {
  for (const auto& [first, second] : touching_soups(4))
    for (const auto& [factor, offset] : {std::pair{1.0, 0.0}, {1.0, 0x1p20}, {0x1p-300, 0.0}, {0x1p300, 0.0}}) {
      const Posed_object a(placed(first, factor, offset)), b(placed(second, factor, offset));
      const auto truth = true_pairs(a.soup(), b.soup());
      EXPECT_FALSE(truth.empty());
      expect_answers(truth, 0, [&](const Contact_request& request) { return search_between(a, b, request); });
    }
}

TEST(Contact_search, does_not_depend_on_scale_and_is_exact_far_from_the_origin) {
  std::mt19937_64 random(2);
  for (const auto& [name, object] : small_objects())
    for (const auto& [factor, offset] : {std::pair{0x1p-300, 0.0}, {0x1p300, 0.0}, {1.0, 0x1p20}, {1.0, -0x1p40}}) {
      SCOPED_TRACE(name);
      const auto base_a = posed_at_random(object, 0.2, random), base_b = posed_at_random(icosphere(5), 0.2, random);
      const Posed_object a(placed(base_a, factor, offset)), b(placed(base_b, factor, offset));
      const auto found = search_between(a, b).found;
      EXPECT_FALSE(found.empty());
      EXPECT_EQ(found, true_pairs(a.soup(), b.soup()));
      if (offset == 0) {
        EXPECT_EQ(found, true_pairs(base_a, base_b));
      }
    }
}

std::vector<Face_pair> nearer_than(const Face_soup& a, const Face_soup& b, double distance) {
  std::vector<Face_pair> pairs;
  for (std::uint32_t i = 0; i < a.faces.size(); ++i)
    for (std::uint32_t j = 0; j < b.faces.size(); ++j)
      if (triangles_nearer_than(a.triangle(i), b.triangle(j), distance)) pairs.push_back({i, j});
  return pairs;
}

TEST(Contact_search, with_a_tolerance_equals_exhaustive_checking_of_distances) {
  std::mt19937_64 random(3);
  const std::vector<Face_soup> objects{icosphere(2), teapot({1, 2}), cloth(8, 7), loose_triangles(90, 0.3, 1),
                                       lattice_soup(60, 40, 4, 1)};
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto pose = posed_at_random(objects[i], 1, random);
    const auto other = posed_at_random(objects[(i + 1) % objects.size()], 1, random);
    for (const double factor : {1.0, 0x1p-300, 0x1p300}) {
      const Posed_object a(placed(pose, factor), 8), b(placed(other, factor), 8, false);
      const double somewhere = closest_points(a.soup().triangle(7), b.soup().triangle(11)).distance;
      for (const double tolerance : {0x1p-40 * factor, 0.03 * factor, 0.2 * factor, somewhere}) {
        if (tolerance == 0) continue;
        const auto truth = nearer_than(a.soup(), b.soup(), tolerance);
        expect_answers(truth, tolerance, [&](const Contact_request& request) { return search_between(a, b, request); });
      }
    }
  }
}

TEST(Contact_search, faces_exactly_as_far_apart_as_the_tolerance_are_no_contact) {
  Face_soup low(cloth(8, 8)), high = low;
  deform(high, [](const Point& p) { return Point(p.x(), p.y(), 0.25); });
  for (const double offset : {0.0, 0x1p20}) {
    const Posed_object a(placed(low, 1, offset)), b(placed(high, 1, offset));
    EXPECT_FALSE(search_between(a, b, {.tolerance = 0.25}).summary.found);
    EXPECT_EQ(search_between(a, b, {.tolerance = std::nextafter(0.25, 1)}).found,
              nearer_than(a.soup(), b.soup(), std::nextafter(0.25, 1)));
    EXPECT_GE(search_between(a, b, {.tolerance = std::nextafter(0.25, 1)}).found.size(), 128U);
  }
}

TEST(Contact_search, finds_the_same_with_any_number_of_workers) {
  std::mt19937_64 random(4);
  const std::vector<Face_soup> objects{icosphere(30), torus_knot({.radius = 0.7, .segments = 600, .sides = 20}),
                                       loose_triangles(8000, 0.05, 1), Face_soup(cloth(100, 60)), icosphere(4)};
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Posed_object a(posed_at_random(objects[i], 0.3, random), 32);
    const Posed_object b(posed_at_random(objects[(i + 1) % objects.size()], 0.3, random), 32);
    const auto truth = true_pairs(a.soup(), b.soup());
    EXPECT_FALSE(truth.empty());
    expect_same_for_any_workers(truth.size(), [&](Searcher& searcher, const Contact_request& request) {
      return searcher.between(a, b, request);
    });
    Searcher several(4);
    expect_answers(truth, 0, [&](const Contact_request& request) { return several.between(a, b, request); });
  }
}

TEST(Contact_search, appends_to_the_list_and_can_be_reused) {
  const Posed_object a(icosphere(6)), b(torus_knot());
  const auto truth = true_pairs(a.soup(), b.soup());
  ASSERT_GT(truth.size(), 2U);
  Workers workers(2);
  Contact_search search(workers);
  const Face_pair before{7, 9};
  std::vector<Face_pair> expected{before}, found{before};
  for (int query = 0; query < 3; ++query) {
    search.between(a.object(), b.object(), {}, found);
    expected.insert(expected.end(), truth.begin(), truth.end());
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(search.between(a.object(), b.object(), {.query = Contact_query::yes_no}, found).found);
    EXPECT_EQ(found, expected);
    std::vector<Face_pair> two{before};
    EXPECT_TRUE(search.between(a.object(), b.object(), {.most = 2}, two).capped);
    EXPECT_EQ(two.size(), 3U);
  }
}

}  // namespace
}  // namespace lodestone
