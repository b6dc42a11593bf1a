// SPDX-License-Identifier: GPL-3.0-or-later
// Two triangles: where they meet, and how far apart they are. Slower than whether they meet, and on the way to the same
// answer.
#include <array>
#include <cmath>

#include "fuzz/triangle_truth.h"
#include "lodestone/triangles/triangle_distance.h"

LODESTONE_FUZZ_TARGET(constructions) {
  using namespace lodestone::fuzz;
  Byte_source bytes(input);
  const auto corners = Triangle_drawer(bytes).draw();
  const bool truth = truly_meet(corners);
  const auto a = triangle(corners, 0), b = triangle(corners, 3);
  const auto expect = [&](bool holds, const char* wrong) {
    if (!holds) fail(wrong + text_of(corners));
  };
  expect(lodestone::triangles_nearer_than(a, b, 0) == truth, "triangles_nearer_than 0 is wrong:");

  const auto points = lodestone::triangle_intersection(a, b);
  expect(points.empty() != truth, "triangle_intersection is wrong:");
  const std::array turned{b[1], b[2], b[0]};
  expect(lodestone::triangle_intersection(turned, a) == points, "triangle_intersection depends on an order:");

  const auto closest = lodestone::closest_points(a, b);
  expect((closest.distance == 0) == truth, "closest_points is wrong:");
  // The distance has an error of at most 2^-30.
  const double nearer = closest.distance * (1 - 0x1p-29), farther = closest.distance * (1 + 0x1p-29);
  if (!std::isnormal(nearer) || !std::isfinite(farther)) return;
  expect(!lodestone::triangles_nearer_than(a, b, nearer), "triangles are nearer than their distance:");
  expect(lodestone::triangles_nearer_than(a, b, farther), "triangles are farther than their distance:");
}
