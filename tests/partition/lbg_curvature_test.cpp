// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/lbg_curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "partition/lathe.h"
#include "partition/partition_checks.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

Feature_vectors factor_of(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  return curvature_factor({numbered.graph, numbered.positions, numbered.faces});
}

TEST(Lbg_curvature, every_surface_gets_exactly_the_requested_regions) { expect_exact_counts(Lbg_curvature{}); }

TEST(Lbg_curvature, odd_surfaces_are_labelled) { expect_odd_surfaces_labelled(Lbg_curvature{}); }

TEST(Lbg_curvature, the_factor_of_a_sphere_is_one_half_whatever_its_size) {
  for (const double radius : {1e-300, 1e-3, 1.0, 1e300}) {
    const auto factor = factor_of(sphere(16, radius));
    EXPECT_NEAR(factor.minCoeff(), 0.5, 0.01);
    EXPECT_NEAR(factor.maxCoeff(), 0.5, 0.01);
  }
}

TEST(Lbg_curvature, the_factor_of_a_spike_is_at_most_1) {
  auto mesh = sphere(10);
  mesh.point(Surface_mesh::Vertex_index(3)) = Point(40, 3, 2);
  const auto factor = factor_of(mesh);
  EXPECT_LE(factor.cwiseAbs().maxCoeff(), 1);
}

TEST(Lbg_curvature, two_regions_by_curvature_alone_are_the_bent_and_the_flat_part) {
  // A sheet whose second half is a quarter of a cylinder.
  auto mesh = grid(41, 7);
  constexpr double radius = 40 / std::numbers::pi;
  deform(mesh, [](const Point& p) {
    const double angle = std::max(0.0, p.x() - 20) / radius;
    return Point(std::min(p.x(), 20.0) + radius * std::sin(angle), p.y(), radius * (std::cos(angle) - 1));
  });
  Lbg_curvature strategy;
  strategy.options.lbg.features.position_weight = 1e-9;
  strategy.options.lbg.features.normal_weight = 0;
  const auto labels = labels_of(strategy, mesh, 2);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    const auto column = v % 41;
    const auto row = v / 41;
    if ((column > 17 && column < 23) || column < 2 || column > 38 || row < 2 || row > 4) continue;
    EXPECT_EQ(labels[v] == labels[3 * 41 + 10], column < 20) << v;
  }
}

TEST(Lbg_curvature, without_weight_it_is_lbg) {
  const auto mesh = potato(12);
  EXPECT_EQ(labels_of(Lbg_curvature{.options = {.curvature_weight = 0}}, mesh, 16), labels_of(Lbg{}, mesh, 16));
  EXPECT_NE(labels_of(Lbg_curvature{}, mesh, 16), labels_of(Lbg{}, mesh, 16));
}

TEST(Lbg_curvature, options_out_of_range_are_refused) {
  for (const double weight : {-1.0, 2e6, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(labels_of(Lbg_curvature{.options = {.curvature_weight = weight}}, tetrahedron(), 2), Bad_argument);
  EXPECT_THROW(labels_of(Lbg_curvature{.options = {.curvature = {.rings = 0}}}, tetrahedron(), 2), Bad_argument);
  EXPECT_THROW(labels_of(Lbg_curvature{}, tetrahedron(), 0), Bad_argument);
}

}  // namespace
}  // namespace lodestone
