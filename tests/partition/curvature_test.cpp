// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/curvature.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/is_closed.h"
#include "partition/lathe.h"
#include "partition/partition_checks.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::vector<double> curvatures_of(const Surface_mesh& mesh, const Curvature_options& options = {}) {
  const Numbered_mesh numbered(mesh);
  return mean_curvatures({numbered.graph, numbered.positions, numbered.faces}, options);
}

/// Whether a surface is closed and its volume, relative to its extent, is more than rounding.
bool encloses_volume(const Surface_soup& soup) {
  if (!is_closed(static_cast<std::uint32_t>(soup.positions.rows()), soup.faces)) return false;
  const Positions scaled = soup.positions / soup.positions.cwiseAbs().maxCoeff();
  double volume = 0;
  for (const auto& [a, b, c] : soup.faces) volume += scaled.row(a).dot(scaled.row(b).cross(scaled.row(c))) / 6;
  return std::abs(volume) > 1e-9;
}

TEST(Curvature, of_a_sphere_is_1_over_its_radius) {
  for (const double radius : {0.25, 1.0, 40.0})
    for (const auto curvature : curvatures_of(sphere(20, radius, {7, -3, 2}))) EXPECT_NEAR(curvature * radius, 1, 0.02);
}

TEST(Curvature, of_a_hollow_sphere_is_negative) {
  auto mesh = sphere(20);
  deform(mesh, [](const Point& p) { return Point(-p.x(), p.y(), p.z()); });  // inside out
  for (const auto curvature : curvatures_of(mesh)) EXPECT_NEAR(curvature, -1, 0.02);
}

TEST(Curvature, converges_with_finer_meshes) {
  const auto worst = [](int parts) {
    double error = 0;
    for (const auto curvature : curvatures_of(sphere(parts))) error = std::max(error, std::abs(curvature - 1));
    return error;
  };
  EXPECT_LT(worst(40), worst(10) / 4);
}

TEST(Curvature, of_a_plane_is_0) {
  auto mesh = grid(9, 7);
  deform(mesh, [](const Point& p) { return Point(p.x(), p.y() + 0.3 * p.x(), 2 * p.x() - p.y() + 5); });
  for (const auto curvature : curvatures_of(mesh)) EXPECT_NEAR(curvature, 0, 1e-12);
}

TEST(Curvature, of_a_cylinder_is_half_that_of_a_sphere_also_at_its_open_ends) {
  constexpr double radius = 3;
  // A sheet of 60 x 15 rolled up by three quarters.
  auto mesh = grid(60, 15);
  deform(mesh, [](const Point& p) {
    const double angle = 1.5 * std::numbers::pi * p.x() / 59;
    return Point(radius * std::cos(angle), radius * std::sin(angle), 0.25 * p.y());
  });
  const auto curvatures = curvatures_of(mesh);
  for (const auto v : mesh.vertices()) {
    const bool at_end = v % 60 < 2 || v % 60 > 57 || v / 60 < 2 || v / 60 > 12;
    EXPECT_NEAR(curvatures[v], 0.5 / radius, (at_end ? 0.05 : 0.01) / radius) << v;
  }
}

TEST(Curvature, of_a_saddle_is_0_where_both_bends_are_equal) {
  auto mesh = grid(41, 41);
  deform(mesh, [](const Point& p) {
    const double x = p.x() / 20 - 1, y = p.y() / 20 - 1;
    return Point(x, y, x * x - y * y);
  });
  EXPECT_NEAR(curvatures_of(mesh)[20 * 41 + 20], 0, 1e-3);
}

TEST(Curvature, is_one_over_the_unit_of_length) {
  const auto mesh = potato(6);
  const auto curvatures = curvatures_of(mesh);
  for (const double factor : {0x1p-900, 0x1p-3, 0x1p900}) {
    auto other = mesh;
    scale(other, factor);
    const auto scaled = curvatures_of(other);
    for (std::size_t v = 0; v < scaled.size(); ++v) EXPECT_DOUBLE_EQ(scaled[v] * factor, curvatures[v]);
  }
}

TEST(Curvature, is_0_where_there_is_nothing_to_fit) {
  for (const auto curvature : curvatures_of(single_triangle())) EXPECT_EQ(curvature, 0);
  for (const auto curvature : curvatures_of(tetrahedron())) EXPECT_EQ(curvature, 0);  // four points are too few
  auto mesh = sphere(4);
  const auto isolated = mesh.add_vertex({50, 0, 0});
  EXPECT_EQ(curvatures_of(mesh)[isolated], 0);
  deform(mesh, [](const Point& p) { return Point(p.x(), 0, 0); });
  for (const auto curvature : curvatures_of(mesh)) EXPECT_EQ(curvature, 0);
  deform(mesh, [](const Point&) { return Point(1, 2, 3); });
  for (const auto curvature : curvatures_of(mesh)) EXPECT_EQ(curvature, 0);
}

TEST(Curvature, on_odd_surfaces_is_finite_and_somewhere_that_of_a_ball_around_them) {
  std::size_t closed = 0;
  for (const auto& soup : odd_surfaces()) {
    const auto curvatures = mean_curvatures(soup.surface());
    for (const auto curvature : curvatures) EXPECT_TRUE(std::isfinite(curvature));
    if (!encloses_volume(soup)) continue;
    ++closed;
    // A closed surface touches the smallest ball around it from inside, and bends there at least as much: by 1 / r,
    // with r at most sqrt(3) times the largest coordinate. The rest is left to the error of the fit.
    const double extent = soup.positions.cwiseAbs().maxCoeff();
    EXPECT_GT(std::ranges::max(curvatures) * extent, 0.9 / std::numbers::sqrt3) << extent;
  }
  EXPECT_GT(closed, 0U);
}

TEST(Curvature, a_hub_with_many_neighbours_is_fitted_to_some_of_them) {
  // A cone of 3000 sides, with the slope 1: the paraboloid z = r^2 goes through the apex and the ring around it. Both
  // its principal curvatures are 2 at the apex.
  const auto mesh = lathe({{0, 1}, {-1, 2}}, 3000, 1);
  const auto curvatures = curvatures_of(mesh, {.rings = 1});
  EXPECT_NEAR(curvatures[6000], 2, 1e-6);
}

TEST(Curvature, around_a_hub_is_that_of_the_sphere_on_which_it_lies) {
  // 10 000 sides around the pole of a unit sphere. The first thousand of them are on one side.
  std::vector<Profile_point> profile;
  for (const double angle : {0.3, 0.2, 0.1}) profile.push_back({std::cos(angle), std::sin(angle)});
  const auto mesh = lathe(profile, 10000, 1 - std::cos(0.1));
  const auto curvatures = curvatures_of(mesh);
  EXPECT_NEAR(curvatures[30001], 1, 0.02);
  for (std::size_t v = 20000; v < 30000; ++v) EXPECT_NEAR(curvatures[v], 1, 0.05) << v;
}

TEST(Curvature, rings_out_of_range_are_refused) {
  EXPECT_THROW(curvatures_of(tetrahedron(), {.rings = 0}), Bad_argument);
  EXPECT_THROW(curvatures_of(tetrahedron(), {.rings = 11}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
