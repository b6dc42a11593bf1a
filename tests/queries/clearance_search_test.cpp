// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/clearance_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/boxed.h"
#include "support/face_soup.h"
#include "support/instruction_sets.h"

namespace lodestone {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The largest of all face pairs.
double by_all_pairs(const Face_soup& a, const Face_soup& b, const Eigen::Vector3d& direction) {
  const Way way(direction, 0x1p-46);
  double most = -infinity;
  for (std::size_t i = 0; i < a.faces.size(); ++i)
    for (std::size_t j = 0; j < b.faces.size(); ++j)
      most = std::max(most, clearance(boxed(a.triangle(i)), boxed(b.triangle(j)), way).length);
  return most;
}

std::vector<Eigen::Vector3d> directions(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> all{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  for (int i = 0; i < 4; ++i)
    all.push_back(Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized());
  return all;
}

TEST(Clearance_search, finds_the_largest_clearance_of_all_face_pairs) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  std::size_t in_line = 0;
  for (std::size_t i = 0; i + 1 < objects.size(); ++i) {
    SCOPED_TRACE(objects[i].first + ", " + objects[i + 1].first);
    const Face_soup& a = objects[i].second;
    const Face_soup b = crumpled(posed_at_random(objects[i + 1].second, 1, random), 0.02, i);
    for (const Eigen::Vector3d& direction : directions(random)) {
      const double truth = by_all_pairs(a, b, direction);
      for (const std::size_t leaf_faces : {2, 16, 128}) {
        const Posed_object posed_a(a, leaf_faces), posed_b(b, 8, false);
        const Layout_view view_a = posed_a.view(), view_b = posed_b.view();
        Clearance_search search(view_a, view_b);
        const auto found = search(direction, infinity);
        ASSERT_TRUE(found);
        if (!std::isfinite(truth)) {
          EXPECT_EQ(found->length, truth);
          continue;
        }
        ++in_line;
        EXPECT_NEAR(search.unscaled(found->length), truth, 1e-10);
      }
    }
  }
  EXPECT_GT(in_line, 50U);
}

TEST(Clearance_search, finds_the_same_along_each_direction_whatever_was_searched_before) {
  std::mt19937_64 random(2);
  const Posed_object a(potato(5)), b(moved(Face_soup(icosphere(5)), 0.7, 0.2, 0.1));
  const Layout_view view_a = a.view(), view_b = b.view();
  Clearance_search again(view_a, view_b);
  for (int round = 0; round < 3; ++round)
    for (const Eigen::Vector3d& direction : directions(random)) {
      Clearance_search fresh(view_a, view_b);
      const auto alone = fresh(direction, infinity), after_others = again(direction, infinity);
      ASSERT_TRUE(alone && after_others);
      EXPECT_EQ(alone->length, after_others->length);
      EXPECT_EQ(alone->normal, after_others->normal);
    }
}

Face_soup two_triangles(std::vector<double> coordinates) {
  Face_soup soup;
  soup.faces = {{0, 1, 2}, {3, 4, 5}};
  soup.coordinates = std::move(coordinates);
  return soup;
}

/// Seen along the direction, the tips of the first two triangles are apart by less than two slacks. A search along the
/// direction leaves them out, one along another direction does not.
TEST(Clearance_search, finds_the_same_where_an_earlier_direction_had_tips_in_line_that_now_just_miss) {
  const Posed_object a(
      two_triangles({0, 0, 0, -0x1.56aae8cd8ef28p-1, -0x1.65bd6ec6c965ep-4, -0x1.053aad22e0cep-5, -0x1.41b6b302ab59cp-3,
                     0x1.1187186779b74p-1, -0x1.42c88c0a7a8ccp-2, 0x1.a7e9ce5922a94p-5, 0x1.7887c6f8edd09p+0,
                     0x1.50d017e0b3347p+1, -0x1.6d99e3f06b2b5p-2, 0x1.d22cb53a3c53p+0, 0x1.4ead8cf4f9fffp+1,
                     -0x1.543203515e397p-2, 0x1.9b017c433f2e4p+0, 0x1.23a938af3979fp+1})),
      b(two_triangles({-0x1.367804989699ep-1, -0x1.60bf81715bddbp-1, 0x1.968e4b29c6fc6p-2, -0x1.3dc074b48106p-5,
                       -0x1.76c721b15e7a3p-1, 0x1.e76e61efcb037p-2, -0x1.2b9ad254d2f3p-4, -0x1.962bc4990fb31p-1,
                       0x1.e086cbddfa56dp-2, -0x1.017acacd7254dp-2, 0x1.2057e69c96dbap+0, 0x1.6a38fc934fa34p+1,
                       -0x1.5208f44480eaap-1, 0x1.79fcd4dde55e1p+0, 0x1.681671a7966ecp+1, -0x1.455503f4fa71cp-1,
                       0x1.42d19be6e8395p+0, 0x1.3d121d61d5e8cp+1}));
  const Eigen::Vector3d direction(-0x1.3678049896a9fp-1, -0x1.60bf81715bd3ep-1, 0x1.968e4b29c6ed7p-2),
      earlier(-0x1.21cffa1cb80d9p-1, -0x1.6cb4564253917p-1, 0x1.a8f0904739e3ap-2);
  const double limit = 0x1.8p-3;
  const Layout_view view_a = a.view(), view_b = b.view();
  const auto alone = Clearance_search(view_a, view_b)(direction, limit);
  Clearance_search search(view_a, view_b);
  ASSERT_TRUE(search(earlier, infinity));
  const auto after_another = search(direction, limit);
  ASSERT_TRUE(alone);
  ASSERT_TRUE(after_another);
  EXPECT_EQ(after_another->length, alone->length);
}

TEST(Clearance_search, gives_none_where_the_clearance_is_not_below_the_limit) {
  std::mt19937_64 random(3);
  const Posed_object a(potato(5)), b(moved(Face_soup(icosphere(5)), 0.7, 0.2, 0.1));
  const Layout_view view_a = a.view(), view_b = b.view();
  Clearance_search search(view_a, view_b);
  for (const Eigen::Vector3d& direction : directions(random)) {
    const auto found = search(direction, infinity);
    ASSERT_TRUE(found);
    EXPECT_FALSE(search(direction, found->length));
    EXPECT_FALSE(search(direction, found->length - 0.1));
    const auto just_above = search(direction, std::nextafter(found->length, infinity));
    ASSERT_TRUE(just_above);
    EXPECT_EQ(just_above->length, found->length);
    EXPECT_EQ(just_above->normal, found->normal);
  }
}

TEST(Clearance_search, gives_the_same_bits_with_every_instruction_set) {
  std::mt19937_64 random(4);
  const Posed_object a(torus_knot({.segments = 40, .sides = 6})), b(crumpled(icosphere(6), 0.05, 5));
  const Layout_view view_a = a.view(), view_b = b.view();
  for (const Eigen::Vector3d& direction : directions(random)) {
    const auto expected = Clearance_search(view_a, view_b)(direction, infinity);
    ASSERT_TRUE(expected);
    for_instruction_sets([&] {
      const auto found = Clearance_search(view_a, view_b)(direction, infinity);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->length, expected->length);
      EXPECT_EQ(found->normal, expected->normal);
    });
  }
}

}  // namespace
}  // namespace lodestone
