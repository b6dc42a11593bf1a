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
      std::vector<Intersection_points> points{{Point(1, 2, 3)}};
      std::vector<Contact_normal> normals(1);
      append_intersections(std::span(pairs).first(count), points);
      append_contact_normals(std::span(pairs).first(count), normals);
      ASSERT_EQ(points.size(), count + 1);
      ASSERT_EQ(normals.size(), count + 1);
      EXPECT_EQ(points.front(), Intersection_points{Point(1, 2, 3)});
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(points[i + 1], points_alone[i]);
        EXPECT_EQ(normals[i + 1].normal, normals_alone[i].normal);
        EXPECT_EQ(normals[i + 1].depth, normals_alone[i].depth);
      }
    }
  });
}

}  // namespace
}  // namespace lodestone
