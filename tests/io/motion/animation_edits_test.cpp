// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/animation_edits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone::test {
namespace {

std::vector<Point> positions_of(const Animation& animation, std::size_t frame) {
  std::vector<Point> positions(animation.vertices);
  animation.motion.pose(frame, positions);
  return positions;
}

/// Two triangles whose shared side is doubled; the copies, vertices 3 and 5, part in frame 1.
Animation split_square() {
  Animation animation{.kind = "test", .vertices = 6, .faces = {{0, 1, 2}, {3, 4, 5}}, .file_face = {0, 1}};
  animation.motion = {
      .frames = 2, .pose = [](std::size_t frame, std::span<Point> positions) {
        const double up = frame == 0 ? 0.001 : 5, z = static_cast<double>(frame);
        const std::vector<Point> all{{0, 0, z}, {1, 0, z}, {1, 1, z}, {1, 1, z + up}, {0, 1, z}, {0, 0, z + up}};
        std::ranges::copy(all, positions.begin());
      }};
  return animation;
}

TEST(Animation_edits, scaling_multiplies_every_frame) {
  const auto twice = scaled(split_square(), 2);
  EXPECT_EQ(positions_of(twice, 0)[2], Point(2, 2, 0));
  EXPECT_EQ(positions_of(twice, 1)[2], Point(2, 2, 2));
  EXPECT_THROW(positions_of(scaled(split_square(), 1e308), 1), Bad_motion);
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(scaled(split_square(), wrong), Bad_argument);
}

TEST(Animation_edits, welding_merges_vertices_that_are_near_in_the_first_frame) {
  const auto welded_square = welded(split_square(), 0.01);
  EXPECT_EQ(welded_square.vertices, 4U);
  EXPECT_EQ(welded_square.faces, (std::vector<Corners>{{0, 1, 2}, {2, 3, 0}}));
  EXPECT_EQ(positions_of(welded_square, 1), (std::vector<Point>{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}));
  EXPECT_EQ(welded(split_square(), 0.0001).vertices, 6U);
  EXPECT_EQ(welded(split_square(), 0).vertices, 6U);
}

TEST(Animation_edits, welding_tells_of_each_frame_which_vertices_it_moves_farthest_apart) {
  std::vector<Parted_vertices> told;
  const auto square = welded(split_square(), 0.01, [&](const Parted_vertices& parted) { told.push_back(parted); });
  positions_of(square, 0);
  EXPECT_TRUE(told.empty()) << "0.001 apart, as they may be";
  positions_of(square, 1);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].frame, 1U);
  EXPECT_EQ(told[0].kept, 2U) << "of two equal distances the first";
  EXPECT_EQ(told[0].merged, 3U);
  EXPECT_EQ(told[0].distance, 5);
}

TEST(Animation_edits, welding_tells_nothing_of_vertices_that_rounding_to_floats_moves_apart) {
  const auto told_for = [](double apart) {
    Animation animation = split_square();
    animation.motion.pose = [apart](std::size_t frame, std::span<Point> positions) {
      const double x = 1000 + (frame == 0 ? 0 : apart);
      std::ranges::copy(std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1000, 1, 0}, {x, 1, 0}, {0, 1, 0}, {0, 0, 0}},
                        positions.begin());
    };
    std::size_t told = 0;
    positions_of(welded(animation, 0, [&](const Parted_vertices&) { ++told; }), 1);
    return told;
  };
  EXPECT_EQ(told_for(0x1p-13), 0U);
  EXPECT_EQ(told_for(0x1p-10), 1U);
}

TEST(Animation_edits, welding_drops_faces_that_lose_a_corner_and_keeps_the_numbers_of_the_others) {
  Animation animation = split_square();
  animation.faces.insert(animation.faces.begin(), {0, 5, 1});
  animation.file_face = {0, 1, 2};
  const auto result = welded(animation, 0.01);
  EXPECT_EQ(result.faces, (std::vector<Corners>{{0, 1, 2}, {2, 3, 0}}));
  EXPECT_EQ(result.file_face, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_THROW(welded(split_square(), 100), Bad_argument) << "no face is left";
  EXPECT_THROW(welded(split_square(), -1), Bad_argument);
}

TEST(Animation_edits, each_vertex_joins_the_first_kept_one_within_the_distance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Point> points;
  for (int i = 0; i < 400; ++i) points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  constexpr double distance = 0.2;
  std::vector<Point> kept;
  std::vector<std::uint32_t> target;
  for (const auto& p : points) {
    std::uint32_t first = 0;
    while (first < kept.size() && CGAL::squared_distance(p, kept[first]) > distance * distance) ++first;
    if (first == kept.size()) kept.push_back(p);
    target.push_back(first);
  }
  Animation animation{.kind = "test", .vertices = points.size(), .faces = {}, .file_face = {}};
  std::vector<Corners> expected;
  for (std::uint32_t v = 0; v < 400; ++v) {
    animation.faces.push_back({v, (v + 1) % 400, (v + 2) % 400});
    animation.file_face.push_back(v);
    const Corners joined{target[v], target[(v + 1) % 400], target[(v + 2) % 400]};
    if (std::set(joined.begin(), joined.end()).size() == 3) expected.push_back(joined);
  }
  animation.motion = {.frames = 1, .pose = [points](std::size_t, std::span<Point> positions) {
                        std::ranges::copy(points, positions.begin());
                      }};
  const auto result = welded(animation, distance);
  EXPECT_EQ(positions_of(result, 0), kept);
  EXPECT_EQ(result.faces, expected);
}

TEST(Animation_edits, subdividing_cuts_each_triangle_into_four_that_tile_it) {
  const auto once = subdivided(split_square(), 1);
  EXPECT_EQ(once.faces.size(), 8U);
  EXPECT_EQ(once.file_face, (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(once.vertices, 12U);
  const auto points = positions_of(once, 1);
  for (std::size_t face = 0; face < 2; ++face) {
    Kernel::Vector_3 sum(0, 0, 0);
    for (std::size_t f = 4 * face; f < 4 * face + 4; ++f) {
      const auto [a, b, c] = once.faces[f];
      sum = sum + CGAL::cross_product(points[b] - points[a], points[c] - points[a]);
    }
    const auto [a, b, c] = split_square().faces[face];
    EXPECT_EQ(sum, CGAL::cross_product(points[b] - points[a], points[c] - points[a]));
  }
  EXPECT_EQ(subdivided(split_square(), 3).faces.size(), 128U);
  EXPECT_EQ(subdivided(welded(split_square(), 0.01), 1).vertices, 9U) << "a shared edge has one midpoint";
}

TEST(Animation_edits, subdividing_the_largest_triangle_stays_finite) {
  static constexpr double largest = std::numeric_limits<double>::max();
  Animation animation = split_square();
  const auto pose = animation.motion.pose;
  animation.motion.pose = [pose](std::size_t frame, std::span<Point> points) {
    pose(frame, points);
    for (auto& p : points) p = {largest, -largest, p.z()};
  };
  const auto points = positions_of(subdivided(std::move(animation), 1), 0);
  for (std::size_t v = 6; v < 12; ++v) EXPECT_EQ(points[v], Point(largest, -largest, points[v].z()));
}

TEST(Animation_edits, changes_of_faces_need_faces) {
  Animation cache = split_square();
  cache.faces.clear();
  EXPECT_THROW(welded(cache, 0), Bad_argument);
  EXPECT_THROW(subdivided(cache, 1), Bad_argument);
  EXPECT_NO_THROW(subdivided(cache, 0));
  EXPECT_THROW(subdivided(split_square(), 60), Bad_argument);
}

}  // namespace
}  // namespace lodestone::test
