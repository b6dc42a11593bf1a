// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/contact_curve.h"

#include <gtest/gtest.h>

#include "lodestone/mesh/errors.h"
#include "particles/owned_surface.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

bool share_an_edge(const Corners& f, const Corners& g) {
  return std::ranges::count_if(f, [&](auto corner) { return std::ranges::find(g, corner) != g.end(); }) == 2;
}

/// The contacts of exhaustive checking that are reached from `seed` by steps from face to face across an edge.
std::vector<Face_pair> curve_of(const Owned_surface& a, const Owned_surface& b, const std::vector<Face_pair>& truth,
                                Face_pair seed) {
  std::vector<Face_pair> curve{seed};
  for (std::size_t done = 0; done < curve.size(); ++done)
    for (const auto& other : truth) {
      const Face_pair here = curve[done];
      const bool beside = (other.a == here.a && share_an_edge(b.walked()[other.b], b.walked()[here.b])) ||
                          (other.b == here.b && share_an_edge(a.walked()[other.a], a.walked()[here.a]));
      if (beside && std::ranges::find(curve, other) == curve.end()) curve.push_back(other);
    }
  std::ranges::sort(curve);
  return curve;
}

std::vector<Face_pair> followed_from(Contact_curve& curve, Face_pair seed) {
  std::vector<Face_pair> found{{999, 999}};
  curve.follow(seed, found);
  EXPECT_EQ(found.front(), (Face_pair{999, 999})) << "what was found before must stay";
  found.erase(found.begin());
  std::ranges::sort(found);
  EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
  return found;
}

/// From each of several contacts the curve is all contacts of the two surfaces.
void expect_one_curve(const Owned_surface& a, const Owned_surface& b) {
  const auto truth = true_pairs(a.soup(), b.soup());
  ASSERT_FALSE(truth.empty());
  Contact_curve curve;
  for (std::size_t seed = 0; seed < truth.size(); seed += 1 + truth.size() / 7) {
    curve.begin(a.view(), b.view());
    EXPECT_EQ(followed_from(curve, truth[seed]), truth);
    EXPECT_GE(curve.exact_tests() + 1, truth.size());
    EXPECT_GE(curve.vertices_read(), 6 * (truth.size() - 1));
    EXPECT_TRUE(followed_from(curve, truth.back()).empty()) << "a contact that was followed before";
  }
}

TEST(Contact_curve, of_two_spheres_is_all_their_contacts_from_any_of_them) {
  expect_one_curve(Owned_surface(sphere(12)), Owned_surface(moved(sphere(10), 1.3, 0.2, 0.1)));
  expect_one_curve(Owned_surface(potato(12)), Owned_surface(moved(potato(12, 2), 1.5, 0.2, 0.1)));
  // More contacts than the memory of the curve begins with.
  expect_one_curve(Owned_surface(sphere(80)), Owned_surface(moved(sphere(80), 0.9, 0.2, 0.1)));
}

TEST(Contact_curve, only_the_curve_of_the_contact_is_followed) {
  Surface_mesh two = sphere(8, 0.3, {1, 0, 0});
  append(two, sphere(8, 0.3, {-1, 0.05, 0.02}));
  const Owned_surface a(sphere(12)), b(two);
  const auto truth = true_pairs(a.soup(), b.soup());
  Contact_curve curve;
  curve.begin(a.view(), b.view());
  const auto first = followed_from(curve, truth.front());
  EXPECT_LT(first.size(), truth.size());
  EXPECT_EQ(first, curve_of(a, b, truth, truth.front()));
  const auto other =
      std::ranges::find_if(truth, [&](Face_pair pair) { return !std::ranges::binary_search(first, pair); });
  ASSERT_NE(other, truth.end());
  auto both = followed_from(curve, *other);
  EXPECT_EQ(both.size() + first.size(), truth.size());
  both.insert(both.end(), first.begin(), first.end());
  std::ranges::sort(both);
  EXPECT_EQ(both, truth);
}

TEST(Contact_curve, is_what_steps_across_edges_reach_for_objects_of_any_kind) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  Contact_curve curve;
  std::size_t several = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Owned_surface a(posed_at_random(objects[i].second, 0.3, random));
    const Owned_surface b(posed_at_random(objects[(i + 1) % objects.size()].second, 0.3, random));
    const auto truth = true_pairs(a.soup(), b.soup());
    ASSERT_FALSE(truth.empty());
    for (std::size_t seed = 0; seed < truth.size(); seed += 1 + truth.size() / 5) {
      curve.begin(a.view(), b.view());
      const auto expected = curve_of(a, b, truth, truth[seed]);
      EXPECT_EQ(followed_from(curve, truth[seed]), expected) << objects[i].first;
      several += expected.size() < truth.size() ? 1 : 0;
    }
  }
  EXPECT_GT(several, 3U);
}

TEST(Contact_curve, goes_on_through_vertices_and_along_edges) {
  // The plane z = 0 contains the equator of the sphere: vertices and edges.
  Face_soup plane;
  plane.coordinates = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
  plane.faces = {{0, 1, 2}, {0, 2, 3}};
  expect_one_curve(Owned_surface(sphere(8)), Owned_surface(plane));
  expect_one_curve(Owned_surface(moved(cube(4), -0.5, -0.5, -0.5)), Owned_surface(plane));
}

TEST(Contact_curve, ends_at_open_borders) {
  auto upright = grid(7, 7);
  deform(upright, [](const Point& p) { return Point(p.x() + 0.3, 2.4, p.y() - 3.2); });
  expect_one_curve(Owned_surface(grid(9, 6)), Owned_surface(upright));
}

TEST(Contact_curve, crosses_seams_that_are_closed_and_stops_at_open_ones) {
  const Face_soup apart = flat_shaded(sphere(8));
  const Owned_surface closed(apart, true), open(apart), other(moved(sphere(7), 1.3, 0.2, 0.1));
  expect_one_curve(closed, other);
  const auto truth = true_pairs(open.soup(), other.soup());
  Contact_curve curve;
  curve.begin(open.view(), other.view());
  const auto found = followed_from(curve, truth.front());
  EXPECT_LT(found.size(), truth.size());
  EXPECT_EQ(found, curve_of(open, other, truth, truth.front()));
}

TEST(Contact_curve, a_coordinate_that_is_not_finite_is_refused) {
  Owned_surface a(sphere(12));
  const Owned_surface b(moved(sphere(10), 1.3, 0.2, 0.1));
  const auto truth = true_pairs(a.soup(), b.soup());
  for (const auto corner : a.soup().faces[truth[truth.size() / 2].a]) a.coordinates()[3 * corner] = not_a_number;
  Contact_curve curve;
  curve.begin(a.view(), b.view());
  std::vector<Face_pair> found;
  EXPECT_THROW(curve.follow(truth.front(), found), Bad_mesh);
  curve.begin(b.view(), b.view());
  EXPECT_NO_THROW(curve.follow({0, 0}, found));
}

}  // namespace
}  // namespace lodestone
