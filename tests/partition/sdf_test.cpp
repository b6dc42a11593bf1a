// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/sdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

#include "lodestone/partition/face_labels.h"
#include "partition/lathe.h"
#include "partition/partition_checks.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::vector<Region_index> segments_of(const Surface_mesh& mesh, const Sdf_options& options = {}) {
  const Numbered_mesh numbered(mesh);
  return sdf_segments({numbered.graph, numbered.positions, numbered.faces}, options);
}

std::size_t number_of(const std::vector<Region_index>& segments) { return 1 + std::ranges::max(segments); }

/// The most frequent label of the vertices between two values of x, and its share.
std::pair<Region_index, double> most_common(const Surface_mesh& mesh, const std::vector<Region_index>& labels,
                                            double low, double high) {
  std::map<Region_index, std::size_t> counts;
  std::size_t all = 0;
  for (const auto v : mesh.vertices()) {
    if (mesh.point(v).x() < low || mesh.point(v).x() > high) continue;
    ++counts[labels[v]];
    ++all;
  }
  const auto best = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
  return {best->first, static_cast<double>(best->second) / static_cast<double>(all)};
}

TEST(Sdf, every_surface_gets_exactly_the_requested_regions) { expect_exact_counts(Sdf{}); }

TEST(Sdf, odd_surfaces_are_labelled) { expect_odd_surfaces_labelled(Sdf{}); }

TEST(Sdf, two_balls_and_the_bridge_between_them_are_three_regions) {
  const auto mesh = dumbbell(1, 1, 0.15);
  const auto labels = labels_of(Sdf{}, mesh, 3);
  const auto [left, left_share] = most_common(mesh, labels, -4, -1.02);
  const auto [bridge, bridge_share] = most_common(mesh, labels, -0.9, 0.9);
  const auto [right, right_share] = most_common(mesh, labels, 1.02, 4);
  EXPECT_NE(left, right);
  EXPECT_NE(left, bridge);
  EXPECT_NE(right, bridge);
  EXPECT_GT(std::min({left_share, bridge_share, right_share}), 0.95);
}

TEST(Sdf, balls_of_unequal_size_are_separated) {
  const auto mesh = dumbbell(1, 0.6, 0.1);
  const auto labels = labels_of(Sdf{}, mesh, 3);
  const auto left = most_common(mesh, labels, -4, -1.02), right = most_common(mesh, labels, 1.02, 4);
  EXPECT_NE(left.first, right.first);
  EXPECT_GT(std::min(left.second, right.second), 0.95);
}

TEST(Sdf, smoothing_decides_whether_a_border_is_worth_its_cost) {
  const auto mesh = dumbbell(1, 1, 0.15);
  EXPECT_EQ(number_of(segments_of(mesh)), 3U);
  EXPECT_EQ(number_of(segments_of(mesh, {.smoothing = 100})), 1U);
}

TEST(Sdf, borders_are_cheap_where_a_surface_is_concave) {
  // The bridge and the balls meet at nearly right angles. A border there costs -log(1/2) where it is concave; where it
  // is convex, -log(0.08/2), over four times as much, which is more than what the bridge gains by a segment of its own.
  const auto mesh = dumbbell(1, 1, 0.15);
  EXPECT_EQ(number_of(segments_of(mesh, {.smoothing = 1.7})), 3U);
}

TEST(Sdf, a_surface_of_uniform_thickness_is_one_segment_per_component) {
  EXPECT_EQ(number_of(segments_of(grid(12, 12))), 1U);  // a sheet: no ray hits anything
  EXPECT_EQ(number_of(segments_of(single_triangle())), 1U);
  auto mesh = grid(5, 5);
  auto beside = grid(4, 4);
  shift(beside, 10);
  append(mesh, beside);
  EXPECT_EQ(number_of(segments_of(mesh)), 2U);
}

TEST(Sdf, the_segments_do_not_depend_on_the_unit) {
  const auto mesh = dumbbell(1, 0.6, 0.1);
  const auto segments = segments_of(mesh);
  for (const double factor : {0x1p-900, 0x1p900}) {
    auto other = mesh;
    scale(other, factor);
    EXPECT_EQ(segments_of(other), segments);
  }
}

TEST(Sdf, an_open_surface_is_segmented) {
  // A dumbbell with the end of one ball cut off: rays leave through the hole.
  auto mesh = dumbbell(1, 1, 0.15);
  std::vector<Corners> faces;
  const Numbered_mesh numbered(mesh);
  for (const auto& face : numbered.faces)
    if (std::ranges::all_of(face, [&](auto v) { return numbered.positions(v, 0) < 2.5; })) faces.push_back(face);
  std::vector<Point> points;
  for (const auto v : mesh.vertices()) points.push_back(mesh.point(v));
  const auto open = mesh_of(points, faces);
  const auto labels = labels_of(Sdf{}, open, 3);
  EXPECT_NE(most_common(open, labels, -4, -1).first, most_common(open, labels, -0.9, 0.9).first);
}

TEST(Sdf, options_out_of_range_are_refused) {
  const auto with = [](const Sdf_options& options) { labels_of(Sdf{.options = options}, tetrahedron(), 2); };
  for (const double angle : {0.0, -1.0, std::numbers::pi, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(with({.cone_angle = angle}), Bad_argument);
  EXPECT_THROW(with({.rays = 0}), Bad_argument);
  EXPECT_THROW(with({.rays = 1001}), Bad_argument);
  EXPECT_THROW(with({.clusters = 1}), Bad_argument);
  EXPECT_THROW(with({.clusters = 101}), Bad_argument);
  EXPECT_THROW(with({.smoothing = -0.1}), Bad_argument);
  EXPECT_THROW(with({.smoothing = std::numeric_limits<double>::infinity()}), Bad_argument);
  EXPECT_THROW(labels_of(Sdf{}, tetrahedron(), 0), Bad_argument);
}

}  // namespace
}  // namespace lodestone
