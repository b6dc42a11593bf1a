// SPDX-License-Identifier: GPL-3.0-or-later
// Contact points and normals of several pairs of triangles at once.
#include <gtest/gtest.h>

#include <vector>

#include "lodestone/triangles/contact_normal.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "support/instruction_sets.h"
#include "support/triangle_pairs.h"

namespace lodestone {
namespace {

/// Pairs of all kinds, so that neighbours in the list take different paths.
std::vector<Triangle_pair> pairs_of_all_kinds(std::size_t count) {
  Triangle_pairs maker(7);
  std::vector<Triangle_pair> pairs;
  while (pairs.size() < count)
    for (const auto& kind : Triangle_pairs::kinds) pairs.push_back((maker.*kind.make)());
  pairs.resize(count);
  return pairs;
}

TEST(Several_contacts, give_what_each_gives_alone_for_each_instruction_set_and_number) {
  const auto pairs = pairs_of_all_kinds(700);
  std::vector<Intersection_points> points_alone;
  std::vector<Contact_normal> normals_alone;
  for (const auto& [a, b] : pairs) {
    points_alone.push_back(triangle_intersection(a, b));
    normals_alone.push_back(contact_normal(a, b));
  }
  for_instruction_sets([&] {
    for (const std::size_t count : {0, 1, 3, 4, 5, 8, 9, 700}) {
      const Intersection_points before{Point(1, 2, 3)};
      std::vector<Intersection_points> points(count + 1, before);
      std::vector<Contact_normal> normals(count + 1);
      triangle_intersections(std::span(pairs).first(count), std::span(points).first(count));
      contact_normals(std::span(pairs).first(count), std::span(normals).first(count));
      EXPECT_EQ(points.back(), before);
      EXPECT_TRUE(normals.back().normal.isZero(0));
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(points[i], points_alone[i]);
        EXPECT_EQ(normals[i].normal, normals_alone[i].normal);
        EXPECT_EQ(normals[i].depth, normals_alone[i].depth);
      }
    }
  });
}

}  // namespace
}  // namespace lodestone
