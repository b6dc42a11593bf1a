// SPDX-License-Identifier: GPL-3.0-or-later
// The exact test of one pair of faces; pairs of a mesh are tested in neighbour_check_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lodestone/triangles/neighbour_check.h"
#include "triangles/adjacent_pairs.h"

namespace lodestone {
namespace {

bool intersect(const Positions& positions, const Corners& a, const Corners& b) {
  const auto position = [&](std::uint32_t v) { return positions.row(v); };
  return faces_intersect(a, face_triangle(a, position), b, face_triangle(b, position));
}

struct Known_faces {
  const char* name;
  std::vector<std::array<int, 3>> points;
  Corners a, b;
  bool meets;
};

const Corners base_face{0, 1, 2};  // and often the points 0, 1, 2 below

const std::vector<Known_faces> known_faces{
    {"no common vertex, apart",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {4, 0, 1}, {0, 4, 1}},
     base_face,
     {3, 4, 5},
     false},
    {"no common number, touching",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 1}, {0, 4, 1}},
     base_face,
     {3, 4, 5},
     true},
    {"vertex only", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-1, 0, 1}, {0, -1, 1}}, base_face, {0, 3, 4}, false},
    {"above each other", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 0, 1}, {0, 4, 1}}, base_face, {0, 3, 4}, false},
    {"through each other, the first shorter",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {9, 9, 1}, {9, 9, -1}},
     base_face,
     {0, 3, 4},
     true},
    {"through each other, the second shorter",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}},
     base_face,
     {0, 3, 4},
     true},
    {"through the plane on the far side",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-1, -1, 1}, {-1, -1, -1}},
     base_face,
     {0, 3, 4},
     false},
    {"through the plane beside",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, -1, 1}, {2, -1, -1}},
     base_face,
     {0, 3, 4},
     false},
    {"along the side from the vertex",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {2, 0, 3}},
     base_face,
     {0, 3, 4},
     true},
    {"touching the opposite side", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 2, 0}, {2, 2, 3}}, base_face, {0, 3, 4}, true},
    {"coplanar beside", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-4, 0, 0}, {0, -4, 0}}, base_face, {0, 3, 4}, false},
    {"coplanar overlapping", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {2, -3, 0}}, base_face, {0, 3, 4}, true},
    {"coplanar within", {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {1, 2, 0}, {2, 1, 0}}, base_face, {0, 3, 4}, true},
    {"sides on one line", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {0, -4, 0}}, base_face, {0, 3, 4}, true},
    {"sides on one line, opposite",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-2, 0, 0}, {0, -4, 0}},
     base_face,
     {0, 3, 4},
     false},
    {"equal points, different numbers",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 0, 0}, {0, -4, 3}},
     base_face,
     {0, 3, 4},
     true},

    {"edge, at an angle", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, base_face, {1, 0, 3}, false},
    {"edge, flat", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, -4, 0}}, base_face, {1, 0, 3}, false},
    {"edge, folded over", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {9, 1, 0}}, base_face, {1, 0, 3}, true},
    {"edge, folded onto itself", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 4, 0}}, base_face, {1, 0, 3}, true},
    {"edge, nearly folded", {{0, 0, 0}, {4, 0, 0}, {0, 400, 0}, {0, 400, 1}}, base_face, {1, 0, 3}, false},
    {"the same face", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, base_face, base_face, true},
    {"the same face turned around", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, base_face, {2, 1, 0}, true},

    {"segment beside a face", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {0, 0, 2}}, base_face, {0, 3, 4}, false},
    {"segment within a face", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {-2, -2, 0}}, base_face, {0, 3, 4}, true},
    {"segment across a face and beyond",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {3, 3, 0}, {9, 9, 0}},
     base_face,
     {0, 3, 4},
     true},
    {"segment along a side", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 0, 0}, {2, 0, 0}}, base_face, {0, 3, 4}, true},
    {"segment on the far side",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-1, -1, 0}, {-2, -2, 0}},
     base_face,
     {0, 3, 4},
     false},
    {"segment that closes a gap along an edge",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}},
     base_face,
     {0, 1, 3},
     false},
    {"segment that goes on beyond an edge", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {9, 0, 0}}, base_face, {0, 1, 3}, false},
    {"segment from an edge of no length", {{0, 0, 0}, {0, 0, 0}, {0, 4, 0}, {1, 2, 0}}, {0, 2, 3}, {0, 1, 2}, false},
    {"point at its vertex", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {0, 0, 0}}, base_face, {0, 3, 4}, false},
    {"segments, same direction",
     {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {-1, -1, -1}},
     base_face,
     {0, 3, 4},
     true},
    {"segments, opposite", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {-3, -3, -3}, {-1, -1, -1}}, base_face, {0, 3, 4}, false},
    {"segments, crossing in the vertex",
     {{0, 0, 0}, {1, 1, 1}, {-1, -1, -1}, {1, 0, 0}, {-1, 0, 0}},
     base_face,
     {0, 3, 4},
     false},
    {"segments, common edge inside both", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, base_face, {0, 1, 3}, true},
    {"segments, common edge between both", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {-3, 0, 0}}, base_face, {0, 1, 3}, false},
    {"segments, common edge is one of them",
     {{0, 0, 0}, {3, 0, 0}, {2, 0, 0}, {-3, 0, 0}},
     base_face,
     {0, 1, 3},
     false},
    {"segments, common edge is a point", {{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {3, 0, 0}}, base_face, {0, 1, 3}, true},
    {"the same segment", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, base_face, {1, 0, 2}, false},
    {"a vertex twice, beside", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 5}}, base_face, {0, 0, 3}, false},
    {"a vertex twice, within", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}}, base_face, {0, 0, 3}, true},
    {"a vertex twice, on an edge", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, base_face, {1, 0, 1}, false},
    {"a vertex three times", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, base_face, {1, 1, 1}, false},
    {"a vertex twice, the same", {{0, 0, 0}, {4, 0, 0}}, {0, 0, 1}, {0, 1, 1}, false},
};

Positions placed(const Known_faces& c, double scale, double offset) {
  Positions positions(static_cast<Eigen::Index>(c.points.size()), 3);
  for (std::size_t v = 0; v < c.points.size(); ++v)
    for (int axis = 0; axis < 3; ++axis) positions(static_cast<int>(v), axis) = scale * c.points[v][axis] + offset;
  return positions;
}

TEST(Definition, is_right_in_the_known_cases) {
  for (const auto& c : known_faces)
    EXPECT_EQ(by_definition::faces_intersect(placed(c, 1, 0), c.a, c.b), c.meets) << c.name;
}

TEST(Faces_intersect, is_right_in_the_known_cases_at_any_scale_position_and_order_of_corners) {
  for (const auto& c : known_faces) {
    Corners a = c.a, b = c.b;
    std::ranges::sort(a);
    do {
      std::ranges::sort(b);
      do
        for (const auto& [scale, offset] :
             {std::pair{1.0, 0.0}, {0x1p-300, 0.0}, {0x1p300, 0.0}, {0x1p-1072, 0.0}, {0x1p1014, 0.0}, {1.0, 0x1p20}}) {
          const auto positions = placed(c, scale, offset);
          EXPECT_EQ(intersect(positions, a, b), c.meets) << c.name << " at " << scale;
          EXPECT_EQ(intersect(positions, b, a), c.meets) << c.name << " at " << scale;
        }
      while (std::ranges::next_permutation(b).found);
    } while (std::ranges::next_permutation(a).found);
  }
}

TEST(Faces_intersect, equals_the_definition_on_small_integers_where_most_pairs_are_degenerate) {
  std::mt19937_64 random(1);
  std::size_t met = 0, trials = 0;
  std::array<std::size_t, 4> by_common{};
  while (trials < 20000) {
    Positions positions(6, 3);
    const auto size = 2 + random() % 3;
    for (double& x : positions.reshaped()) x = static_cast<double>(random() % size);
    Corners a{}, b{};
    for (auto* face : {&a, &b})
      for (auto& corner : *face) corner = static_cast<std::uint32_t>(random() % 6);
    const bool expected = by_definition::faces_intersect(positions, a, b);
    ASSERT_EQ(intersect(positions, a, b), expected) << positions << " trial " << trials;
    ++by_common[common_vertices(a, b).size()];
    met += expected ? 1 : 0;
    ++trials;
  }
  EXPECT_GT(met, trials / 10);
  EXPECT_LT(met, trials / 2);
  for (const auto count : by_common) EXPECT_GT(count, trials / 100);
}

}  // namespace
}  // namespace lodestone
