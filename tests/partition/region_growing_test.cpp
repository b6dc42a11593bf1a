// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/region_growing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "lodestone/partition/face_labels.h"
#include "partition/partition_checks.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::vector<Region_index> areas_of(const Surface_mesh& mesh, const Region_growing_options& options = {}) {
  const Numbered_mesh numbered(mesh);
  return flat_areas({numbered.graph, numbered.positions, numbered.faces}, options);
}

TEST(Region_growing, every_surface_gets_exactly_the_requested_regions) { expect_exact_counts(Region_growing{}); }

TEST(Region_growing, odd_surfaces_are_labelled) { expect_odd_surfaces_labelled(Region_growing{}); }

TEST(Region_growing, the_areas_of_a_box_are_its_sides) {
  auto mesh = cube(5);
  deform(mesh, [](const Point& p) { return Point(3 * p.x(), 2 * p.y(), p.z()); });
  const auto areas = areas_of(mesh);
  // `cube` makes its sides one after the other, 2 * 25 faces each.
  for (std::size_t f = 0; f < areas.size(); ++f) EXPECT_EQ(areas[f], f / 50);
}

TEST(Region_growing, a_bend_above_the_angle_separates_two_areas) {
  auto mesh = grid(21, 5);
  deform(mesh, [](const Point& p) { return Point(p.x(), p.y(), 0.5 * std::max(0.0, p.x() - 10)); });  // 26.6 degrees
  const auto number_of = [&](const Region_growing_options& options) {
    return 1 + std::ranges::max(areas_of(mesh, options));
  };
  EXPECT_EQ(number_of({.angle = 20, .distance = 1}), 2U);
  EXPECT_EQ(number_of({.angle = 40, .distance = 1}), 1U);
}

TEST(Region_growing, a_distance_from_the_plane_separates_two_areas) {
  // The step between two levels is steep but small; with a generous angle the distance alone counts.
  auto mesh = grid(21, 5);
  deform(mesh, [](const Point& p) { return Point(p.x(), p.y(), p.x() > 10.5 ? 1 : 0); });
  const auto number_of = [&](const Region_growing_options& options) {
    return 1 + std::ranges::max(areas_of(mesh, options));
  };
  EXPECT_EQ(number_of({.angle = 80, .distance = 0.5}), 1U);
  EXPECT_GT(number_of({.angle = 80, .distance = 0.01}), 1U);
}

TEST(Region_growing, the_areas_do_not_depend_on_the_unit) {
  const auto mesh = potato(10);
  const auto areas = areas_of(mesh);
  for (const double factor : {0x1p-900, 0x1p900}) {
    auto other = mesh;
    scale(other, factor);
    EXPECT_EQ(areas_of(other), areas);
  }
}

TEST(Region_growing, options_out_of_range_are_refused) {
  const auto with = [](const Region_growing_options& options) { areas_of(tetrahedron(), options); };
  for (const double angle : {-1.0, 91.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(with({.angle = angle}), Bad_argument);
  for (const double distance : {-1.0, 2.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(with({.distance = distance}), Bad_argument);
  EXPECT_THROW(labels_of(Region_growing{}, tetrahedron(), 0), Bad_argument);
}

}  // namespace
}  // namespace lodestone
