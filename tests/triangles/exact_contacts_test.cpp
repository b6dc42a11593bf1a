// SPDX-License-Identifier: GPL-3.0-or-later
// Single pairs of features. In two whole triangles another pair often meets at the same time and hides a mistake.
#include "triangles/exact_contacts.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "support/moving_triangles.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

double time_of(Exact_contacts& contacts) {
  return contacts.first() ? Impact_time(*contacts.first()).value() : infinity;
}

/// When corner 0 of a is first on b.
double corner_on_face(const Point& from, const Point& to, const Moving_triangle& b) {
  const Point far(1e3, 1e3, 1e3);
  Exact_contacts contacts({{from, far, far}, {to, far, far}}, b);
  contacts.try_corner_and_face(0, {3, 4, 5});
  return time_of(contacts);
}

using Edge = std::array<Point, 2>;

/// When two edges first meet, each given at the start and at the end.
double edges_meet(const Edge& a_start, const Edge& a_end, const Edge& b_start, const Edge& b_end) {
  const Point far(1e3, 1e3, 1e3);
  Exact_contacts contacts({{a_start[0], a_start[1], far}, {a_end[0], a_end[1], far}},
                          {{b_start[0], b_start[1], far}, {b_end[0], b_end[1], far}});
  contacts.try_edges({0, 1}, {3, 4});
  return time_of(contacts);
}

TEST(Exact_contacts, of_a_corner_and_a_face_that_collapses_at_that_moment) {
  // In one line along x at t = 1/2.
  const Moving_triangle turning{{Point(-1, -1, 1), Point(1, -1, 1), Point(0, 3, 1)},
                                {Point(-1, 1, -1), Point(1, 1, -1), Point(0, -3, -1)}};
  EXPECT_EQ(corner_on_face({0.5, 0, 1}, {0.5, 0, -1}, turning), 0.5);
  EXPECT_EQ(corner_on_face({0.5, 0.25, 0}, {0.5, -0.25, 0}, turning), 0.5);
  EXPECT_EQ(corner_on_face({1.5, 0.25, 0}, {1.5, -0.25, 0}, turning), infinity);
  // To a point.
  const Moving_triangle through{{Point(-1, -1, 1), Point(1, -1, 1), Point(0, 3, 1)},
                                {Point(1, 1, -1), Point(-1, 1, -1), Point(0, -3, -1)}};
  EXPECT_EQ(corner_on_face({0, 0.25, 0}, {0, -0.25, 0}, through), 0.5);
  EXPECT_EQ(corner_on_face({0x1p-40, 0.25, 0}, {0x1p-40, -0.25, 0}, through), infinity);
}

TEST(Exact_contacts, of_a_corner_in_the_plane_of_a_face) {
  const Triangle t{Point(0, 0, 0), Point(4, 0, 0), Point(0, 4, 0)};
  EXPECT_EQ(corner_on_face({1, -1, 0}, {1, 2, 0}, {t, t}), 1.0 / 3);
  EXPECT_EQ(corner_on_face({5, 5, 0}, {-1, -1, 0}, {t, t}), 0.5);
  EXPECT_EQ(corner_on_face({-1, 0, 0}, {3, 0, 0}, {t, t}), 0.25) << "along an edge";
  EXPECT_EQ(corner_on_face({5, 0, 0}, {0, 5, 0}, {t, t}), infinity);
  const Triangle point{Point(1, 1, 1), Point(1, 1, 1), Point(1, 1, 1)};
  EXPECT_EQ(corner_on_face({0, 0, 0}, {3, 3, 3}, {point, point}), 1.0 / 3);
  EXPECT_EQ(corner_on_face({0, 0, 0}, {3, 3, 4}, {point, point}), infinity);
}

TEST(Exact_contacts, of_edges_that_are_parallel_at_that_moment) {
  const Edge along_x{Point(-1, 0, 0), Point(1, 0, 0)};
  // It turns about z, and comes down along y.
  EXPECT_EQ(
      edges_meet(along_x, along_x, {Point(0.5, 1, 0.5), Point(2, 1, -0.5)}, {Point(0.5, -1, -0.5), Point(2, -1, 0.5)}),
      0.5);
  EXPECT_EQ(
      edges_meet(along_x, along_x, {Point(1.5, 1, 0.5), Point(2, 1, -0.5)}, {Point(1.5, -1, -0.5), Point(2, -1, 0.5)}),
      infinity);
  // One is a point.
  const Edge point{Point(0.5, 1, 0), Point(0.5, 1, 0)}, below{Point(0.5, -3, 0), Point(0.5, -3, 0)};
  EXPECT_EQ(edges_meet(along_x, along_x, point, below), 0.25);
  EXPECT_EQ(edges_meet(point, below, along_x, along_x), 0.25);
}

TEST(Exact_contacts, of_edges_that_move_in_one_plane) {
  const Edge along_x{Point(-1, 0, 0), Point(1, 0, 0)};
  EXPECT_EQ(edges_meet(along_x, along_x, {Point(0, 1, 0), Point(1, 2, 0)}, {Point(0, -3, 0), Point(1, -2, 0)}), 0.25);
  EXPECT_EQ(edges_meet(along_x, along_x, {Point(3, 1, 0), Point(3, -1, 0)}, {Point(-1, 1, 0), Point(-1, -1, 0)}), 0.5);
  EXPECT_EQ(edges_meet(along_x, along_x, {Point(2, 0, 0), Point(5, 0, 0)}, {Point(-1, 0, 0), Point(2, 0, 0)}), 1.0 / 3);
  EXPECT_EQ(edges_meet(along_x, along_x, {Point(2, 0, 0), Point(5, 0, 0)}, {Point(1.5, 0, 0), Point(2, 0, 0)}),
            infinity);
}

/// The first impact by the exact test of all pairs of features, without a filter.
std::optional<Impact_time> first_of_all_features(const Moving_pair& pair) {
  if (triangles_intersect(pair.a.start, pair.b.start)) return Impact_time();
  Exact_contacts contacts(pair.a, pair.b);
  for (int i = 0; i < 3; ++i) {
    contacts.try_corner_and_face(i, {3, 4, 5});
    contacts.try_corner_and_face(3 + i, {0, 1, 2});
    for (int j = 0; j < 3; ++j) contacts.try_edges({i, (i + 1) % 3}, {3 + j, 3 + (j + 1) % 3});
  }
  if (!contacts.first()) return std::nullopt;
  return Impact_time(*contacts.first());
}

TEST(Exact_contacts, of_all_features_give_the_first_impact_of_two_triangles) {
  Moving_pairs pairs(1);
  int met = 0, apart = 0;
  for (int i = 0; i < 6000; ++i) {
    const Moving_pair pair = i % 3 == 0   ? pairs.on_a_lattice()
                             : i % 3 == 1 ? pairs.beside_a_lattice()
                                          : pairs.anywhere();
    const auto first = first_of_all_features(pair);
    ASSERT_EQ(first_impact(pair.a, pair.b), first) << i;
    ASSERT_TRUE(!first || first_impact(pair.a, pair.b, first->high()) == first) << i;
    ++(first ? met : apart);
  }
  EXPECT_GT(met, 2000);
  EXPECT_GT(apart, 1000);
}

}  // namespace
}  // namespace lodestone
