// SPDX-License-Identifier: GPL-3.0-or-later
// Single fans for which the proof from one direction just holds or just fails; tested through the public class.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "triangles/adjacent_pairs.h"

namespace lodestone {
namespace {

/// Faces around vertex 0, with the corners of the rim at `place(i)`, i = 0 .. count - 1.
template <class Place>
Surface_mesh fan(std::uint32_t count, bool closed, Place place) {
  std::vector<Point> points{{0, 0, 0}};
  std::vector<Corners> faces;
  for (std::uint32_t i = 0; i < count; ++i) points.push_back(place(i));
  for (std::uint32_t i = 0; i + (closed ? 0 : 1) < count; ++i) faces.push_back({0, i + 1, (i + 1) % count + 1});
  return mesh_of(points, faces);
}

Point on_circle(double angle, double height) { return {std::cos(angle), std::sin(angle), height}; }

TEST(Fan_projection, accepts_a_fan_of_2000_faces) {
  for (const std::uint32_t count : {100, 2000}) {
    const double step = 2 * std::numbers::pi / count;
    const auto cone = fan(count, true, [&](std::uint32_t i) { return on_circle(step * i, 0.5); });
    EXPECT_TRUE(answer(cone).pairs.empty());
    EXPECT_EQ(answer(cone).exact_tests, 0U);

    // Flat, and one neighbour steps over the next four: both its faces lie over four others and each other.
    const auto torn = fan(count, true, [&](std::uint32_t i) { return on_circle(step * (i == 7 ? 11.5 : i), 0); });
    const std::vector<Face_pair> expected{{6, 7}, {6, 8}, {6, 9}, {6, 10}, {6, 11}, {7, 8}, {7, 9}, {7, 10}, {7, 11}};
    EXPECT_EQ(answer(torn).pairs, expected);
    if (count == 100) {
      EXPECT_EQ(expect_equal_to_cgal(torn), expected.size());
    }
  }
}

TEST(Fan_projection, detects_fans_that_turn_more_than_once) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> height(-1, 1);
  std::size_t met = 0, apart = 0;
  for (const std::uint32_t count : {5, 6, 8, 15})
    for (const bool closed : {true, false})
      for (const double turns : {0.4, 0.6, 0.9, 1.0, 1.1, 1.3, 1.5, 1.7, 2.0})
        for (const double start : {0.0, 0.5, 1.0, 1.5, 3.0, 4.5}) {
          if (closed && turns != std::round(turns)) continue;
          const double step = 2 * std::numbers::pi * turns / (closed ? count : count - 1);
          // A spiral staircase, or a flat one; from above it always winds around.
          const bool flat = random() % 2 == 0;
          auto mesh = fan(count, closed, [&](std::uint32_t i) {
            const double far = 0.5 + 0.5 * std::abs(height(random)), angle = start + step * i;
            return Point(far * std::cos(angle), far * std::sin(angle), flat ? 0 : 0.3 * height(random));
          });
          const auto pairs = expect_equal_to_cgal(mesh);
          turn(mesh);
          (pairs > 0 ? met : apart) += 1;
          expect_equal_to_cgal(mesh);
        }
  EXPECT_GT(met, 30U);
  EXPECT_GT(apart, 30U);
}

TEST(Fan_projection, detects_an_arm_that_turns_back_by_the_last_digit) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> place(-1, 1);
  std::size_t met = 0, apart = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    // In the plane z = 0, neighbours 2 and 3 are in the same direction from vertex 0, up to their last digits. The
    // vertex has more digits than they have, so differences are rounded.
    const double x = place(random) / 64, y = place(random) / 64, start = place(random);
    const double longer = 1 + place(random) / 2;
    auto mesh = fan(6, true, [&](std::uint32_t i) {
      const Point p = on_circle(start + static_cast<double>(i < 3 ? i + 1 : i), 0), q = on_circle(start + 2, 0);
      return i == 2 ? Point(x + longer * q.x(), y + longer * q.y(), 0) : Point(x + p.x(), y + p.y(), 0);
    });
    mesh.point(Surface_mesh::Vertex_index(0)) = Point(x, y, 0);
    (expect_equal_to_cgal(mesh) > 0 ? met : apart) += 1;
  }
  EXPECT_GT(met, 200U);
  EXPECT_GT(apart, 200U);
}

}  // namespace
}  // namespace lodestone
