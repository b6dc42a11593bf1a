// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/ring_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "lodestone/mesh/errors.h"
#include "lodestone/particles/hop_metric.h"
#include "support/owned_surface.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

/// The faces with a corner less than `rings` hops from a vertex, by searching the whole surface.
std::vector<std::uint32_t> faces_of_rings(const Owned_surface& surface, std::uint32_t centre, std::size_t rings) {
  const auto hops = breadth_first_hops(surface.graph(), centre);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t face = 0; face < surface.walked().size(); ++face)
    if (std::ranges::any_of(surface.walked()[face], [&](std::uint32_t corner) { return hops[corner] < rings; }))
      faces.push_back(face);
  return faces;
}

/// All contacts among the rings, by testing every face against every other.
std::set<Face_pair> contacts_of_rings(const Owned_surface& a, const Owned_surface& b, Meeting at, std::size_t rings) {
  std::set<Face_pair> contacts;
  for (const auto face_a : faces_of_rings(a, at.a, rings))
    for (const auto face_b : faces_of_rings(b, at.b, rings))
      if (triangles_intersect(a.soup().triangle(face_a), b.soup().triangle(face_b))) contacts.insert({face_a, face_b});
  return contacts;
}

/// Checks around many pairs of vertices; gives the number of checks that found a contact, and of those that did not.
std::pair<std::size_t, std::size_t> expect_rings(const Owned_surface& a, const Owned_surface& b, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Ring_check check;
  std::size_t found_some = 0, found_none = 0;
  for (int i = 0; i < 300; ++i) {
    const auto& face_a = a.walked()[random() % a.walked().size()];
    // Near the first vertex, so that many rings overlap.
    std::uint32_t nearest = b.walked()[0][0];
    for (const auto& face_b : b.walked())
      if ((b.at(face_b[0]) - a.at(face_a[0])).norm() < (b.at(nearest) - a.at(face_a[0])).norm()) nearest = face_b[0];
    const Meeting at{face_a[0], nearest};
    for (const std::size_t rings : {0, 1, 2, 3}) {
      const auto expected = contacts_of_rings(a, b, at, rings);
      Face_pair found{77, 88};
      EXPECT_EQ(check.check(a.view(), b.view(), at, rings, found), !expected.empty());
      if (!expected.empty()) {
        EXPECT_TRUE(expected.contains(found));
      }
      (expected.empty() ? found_none : found_some) += 1;
    }
  }
  return {found_some, found_none};
}

TEST(Ring_check, finds_a_contact_exactly_where_testing_every_face_of_the_rings_does) {
  const Owned_surface a(potato(8)), b(moved(potato(7, 2), 1.2, 0.3, 0.1)), knot(torus_knot({.radius = 0.7}));
  std::size_t found_some = 0, found_none = 0;
  for (const auto& [first, second] : {std::pair(&a, &b), std::pair(&b, &a), std::pair(&a, &knot)}) {
    const auto [some, none] = expect_rings(*first, *second, 1);
    found_some += some, found_none += none;
  }
  EXPECT_GT(found_some, 100U);
  EXPECT_GT(found_none, 100U);
}

TEST(Ring_check, rings_go_on_across_closed_seams_and_end_at_open_borders) {
  const Owned_surface apart(flat_shaded(sphere(6)), true), sheet(moved(grid(9, 9), -0.4, -0.4, 0.3));
  const auto [some, none] = expect_rings(apart, sheet, 2);
  EXPECT_GT(some, 20U);
  EXPECT_GT(none, 20U);
}

TEST(Ring_check, reads_three_positions_of_each_face_of_its_rings) {
  const Owned_surface a(sphere(6)), b(moved(sphere(6), 9, 0, 0));
  for (const std::size_t rings : {0, 1, 2, 3}) {
    Ring_check check;
    Face_pair found;
    EXPECT_FALSE(check.check(a.view(), b.view(), {0, 40}, rings, found));
    EXPECT_EQ(check.vertices_read(), 3 * (faces_of_rings(a, 0, rings).size() + faces_of_rings(b, 40, rings).size()));
    EXPECT_EQ(check.exact_tests(), 0U);
  }
}

TEST(Ring_check, counts_what_it_tests_and_reads_until_told_to_begin_anew) {
  const Owned_surface a(sphere(6)), b(moved(sphere(6), 0.1, 0, 0));
  Ring_check check;
  Face_pair found;
  ASSERT_TRUE(check.check(a.view(), b.view(), {0, 0}, 2, found));
  const std::size_t tests = check.exact_tests(), reads = check.vertices_read();
  EXPECT_GT(tests, 0U);
  EXPECT_GT(reads, 0U);
  EXPECT_TRUE(check.check(a.view(), b.view(), {0, 0}, 2, found));
  EXPECT_EQ(check.exact_tests(), 2 * tests);
  EXPECT_EQ(check.vertices_read(), 2 * reads);
  check.reset_counts();
  EXPECT_EQ(check.exact_tests() + check.vertices_read(), 0U);
}

/// A cone of so many faces around its tip, which is vertex 0.
Face_soup cone(std::uint32_t count) {
  Face_soup soup;
  soup.coordinates = {0, 0, 0};
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    soup.coordinates.insert(soup.coordinates.end(), {std::cos(angle), std::sin(angle), 1});
    soup.faces.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return soup;
}

TEST(Ring_check, a_vertex_with_too_many_faces_is_not_tested) {
  for (const std::uint32_t faces : {512, 513}) {
    const Owned_surface many(cone(faces)), few(moved(cone(16), 0, 0, 0.1));
    const bool tested = faces <= Ring_check::most_faces;
    for (const bool swapped : {false, true}) {
      Ring_check check;
      Face_pair found;
      const bool touches = swapped ? check.check(few.view(), many.view(), {0, 0}, 1, found)
                                   : check.check(many.view(), few.view(), {0, 0}, 1, found);
      EXPECT_EQ(touches, tested && !contacts_of_rings(many, few, {0, 0}, 1).empty());
      EXPECT_EQ(check.vertices_read() > 0, tested);
    }
  }
  const Owned_surface a(cone(512)), b(moved(cone(512), 0.01, 0, 0));
  Ring_check check;
  Face_pair found;
  EXPECT_TRUE(check.check(a.view(), b.view(), {0, 0}, 1, found));
}

TEST(Ring_check, a_coordinate_that_is_not_finite_is_refused) {
  for (const double bad : {not_a_number, infinity}) {
    Owned_surface a(sphere(6));
    const Owned_surface b(moved(sphere(6), 9, 0, 0));
    a.coordinates()[3 * std::size_t{*neighbours(a.graph(), 4).begin()} + 2] = bad;
    Ring_check check;
    Face_pair found;
    EXPECT_THROW(check.check(a.view(), b.view(), {4, 0}, 1, found), Bad_mesh);
    EXPECT_THROW(check.check(b.view(), a.view(), {0, 4}, 1, found), Bad_mesh);
  }
}

}  // namespace
}  // namespace lodestone
