// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/vsa.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "lodestone/partition/region_count.h"
#include "partition/partition_checks.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

TEST(Vsa, every_surface_gets_exactly_the_requested_regions) { expect_exact_counts(Vsa{}); }

TEST(Vsa, odd_surfaces_are_labelled) { expect_odd_surfaces_labelled(Vsa{}); }

TEST(Vsa, six_regions_of_a_box_are_its_sides) {
  auto mesh = cube(8);
  deform(mesh, [](const Point& p) { return Point(3 * p.x(), 2 * p.y(), p.z()); });
  const auto labels = labels_of(Vsa{}, mesh, 6);
  std::array<std::set<Region_index>, 6> of_side;
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    const Point& p = mesh.point(Surface_mesh::Vertex_index(v));
    const bool on[6] = {p.x() == 0, p.x() == 3, p.y() == 0, p.y() == 2, p.z() == 0, p.z() == 1};
    if (std::ranges::count(on, true) == 1) of_side.at(std::ranges::find(on, true) - on).insert(labels[v]);
  }
  std::set<Region_index> all;
  for (const auto& side : of_side) {
    EXPECT_EQ(side.size(), 1U);
    all.insert(side.begin(), side.end());
  }
  EXPECT_EQ(all.size(), 6U);
}

TEST(Vsa, a_roof_is_cut_along_its_ridge) {
  auto mesh = grid(21, 6);
  deform(mesh, [](const Point& p) { return Point(p.x(), p.y(), 7 - std::abs(p.x() - 7)); });
  const auto labels = labels_of(Vsa{}, mesh, 2);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (v % 21 == 7) continue;  // on the ridge itself
    EXPECT_EQ(labels[v] == labels[0], v % 21 < 7) << v;
  }
}

TEST(Vsa, the_seeding_does_not_change_the_number_of_regions) {
  const auto mesh = potato(16);
  for (const std::size_t singles : {0, 5, 100}) {
    const auto sizes = label_sizes(Vsa{.options = {.single_insertions = singles}}, mesh, 40);
    EXPECT_EQ(sizes.size(), 40U);
  }
}

TEST(Vsa, a_flat_surface_is_left_to_the_cuts_at_the_median) {
  auto flat = grid(24, 18);
  for (const double slope : {0.0, 0.3}) {
    deform(flat, [&](const Point& p) { return Point(p.x(), p.y(), slope * p.x() + 0.7 * slope * p.y()); });
    const Numbered_mesh numbered(flat);
    std::vector<Region_index> cut(flat.number_of_vertices(), 0);
    adjust_region_count(numbered.graph, numbered.positions, cut, 20);
    EXPECT_EQ(labels_of(Vsa{}, flat, 20), cut) << slope;
    EXPECT_EQ(labels_of(Vsa{.options = {.single_insertions = 0}}, flat, 20), cut) << slope;
  }
}

TEST(Vsa, relaxations_are_counted) {
  const auto mesh = potato(8);
  const Numbered_mesh numbered(mesh);
  const auto labelling = Vsa{.options = {.relaxations = 3, .max_iterations = 0}}.label(
      {numbered.graph, numbered.positions, numbered.faces}, 5);
  EXPECT_EQ(labelling.iterations, 4 * 3 + 1U);  // four further proxies, and the last pass
  const auto doubled = Vsa{.options = {.relaxations = 3, .single_insertions = 0, .max_iterations = 0}}.label(
      {numbered.graph, numbered.positions, numbered.faces}, 4);
  EXPECT_EQ(doubled.iterations, 2 * 3 + 1U);  // from one to two, and to four
}

TEST(Vsa, options_out_of_range_are_refused) {
  const auto with = [](const Vsa_options& options) { labels_of(Vsa{.options = options}, tetrahedron(), 2); };
  EXPECT_THROW(with({.relaxations = 0}), Bad_argument);
  EXPECT_THROW(with({.relaxations = 101}), Bad_argument);
  EXPECT_THROW(with({.single_insertions = 1000001}), Bad_argument);
  for (const double tolerance : {0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(with({.tolerance = tolerance}), Bad_argument);
  EXPECT_THROW(with({.max_iterations = 1000001}), Bad_argument);
  EXPECT_THROW(labels_of(Vsa{}, tetrahedron(), 0), Bad_argument);
}

}  // namespace
}  // namespace lodestone
