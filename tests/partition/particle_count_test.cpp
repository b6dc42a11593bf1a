// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/particle_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/special_numbers.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Sizes = std::vector<double>;

std::vector<Sphere> spheres_of(const Surface_mesh& mesh, const Particle_count_options& options = {}) {
  const Numbered_mesh numbered(mesh);
  return sphere_collection(numbered.graph, numbered.positions, numbered.faces, options);
}

/// 4 pi / (2 pi (1 - cos theta)) with theta = asin(r / (R + r)), as published.
long double shadows(long double large, long double small) {
  return 2 / (1 - std::cos(std::asin(small / (large + small))));
}

TEST(Particle_count, equal_spheres_need_at_most_the_kissing_number) {
  EXPECT_EQ(kissing_particle_count(12), 12U);
  EXPECT_EQ(kissing_particle_count(13), 12U);
  EXPECT_EQ(kissing_particle_count(100000), 12U);
}

TEST(Particle_count, fewer_objects_than_the_kissing_number_need_as_many_particles) {
  for (const std::size_t objects : {1, 2, 7, 11}) EXPECT_EQ(kissing_particle_count(objects), objects);
}

TEST(Particle_count, the_shadow_formula_gives_14_for_equal_spheres) {
  // 2 / (1 - cos 30 degrees) = 14.93
  for (const double radius : {1.0, 0.3, 1e-200, 1e200}) EXPECT_EQ(shadow_particle_count(radius, radius), 14U);
}

TEST(Particle_count, the_shadow_formula_holds_for_other_ratios) {
  EXPECT_EQ(shadow_particle_count(3, 1), 62U);  // sin theta = 1/4: 2 / (1 - sqrt(15) / 4) = 62.98
  for (double ratio = 0.01; ratio < 300; ratio *= 1.37) {
    const long double exact = shadows(ratio, 1);
    if (std::abs(exact - std::round(exact)) < 1e-6L) continue;
    EXPECT_EQ(shadow_particle_count(ratio, 1), static_cast<std::size_t>(std::floor(exact))) << ratio;
    EXPECT_EQ(shadow_particle_count(ratio * 0x1p-70, 0x1p-70), static_cast<std::size_t>(std::floor(exact))) << ratio;
  }
  EXPECT_EQ(shadow_particle_count(1e-9, 1), 2U);  // the shadow is nearly half of the sphere
}

TEST(Particle_count, a_shadow_needs_two_radii_above_0) {
  for (const double bad : {0.0, -1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(shadow_particle_count(bad, 1), Bad_argument) << bad;
    EXPECT_THROW(shadow_particle_count(1, bad), Bad_argument) << bad;
  }
}

TEST(Particle_count, a_bounding_sphere_is_the_smallest_one) {
  const Numbered_mesh ball(sphere(4, 2.5, {10, -3, 7}));
  EXPECT_NEAR(bounding_sphere(ball.positions).radius, 2.5, 1e-9);
  EXPECT_TRUE(bounding_sphere(ball.positions).centre.isApprox(Eigen::Vector3d(10, -3, 7), 1e-9));

  const Numbered_mesh box(cube(3));
  EXPECT_NEAR(bounding_sphere(box.positions).radius, std::sqrt(3) / 2, 1e-9);

  const Positions line = (Positions(3, 3) << 0, 0, 0, 1, 0, 0, 6, 0, 0).finished();
  EXPECT_NEAR(bounding_sphere(line).radius, 3, 1e-9);
  EXPECT_EQ(bounding_sphere(Positions::Constant(5, 3, 2.0)).radius, 0);
  EXPECT_NEAR(bounding_sphere(line * 0x1p600).radius * 0x1p-600, 3, 1e-9);
  EXPECT_NEAR(bounding_sphere(line * 0x1p-600).radius * 0x1p600, 3, 1e-9);
}

TEST(Particle_count, a_bounding_sphere_of_a_surface_goes_around_what_faces_use) {
  auto mesh = sphere(6, 2.5, {10, -3, 7});
  mesh.add_vertex({1000, 0, 0});
  const Numbered_mesh numbered(mesh);
  EXPECT_NEAR(bounding_sphere(numbered.positions, numbered.faces).radius, 2.5, 1e-9);
  EXPECT_GT(bounding_sphere(numbered.positions).radius, 400);
  EXPECT_EQ(bounding_sphere(numbered.positions, {}).radius, bounding_sphere(numbered.positions).radius);
}

TEST(Sphere_collection, of_creases_only_does_not_reach_to_vertices_without_faces) {
  auto mesh = cube(1);
  mesh.add_vertex({1000, 0, 0});
  const auto spheres = spheres_of(mesh, {.smallest_part = 1});
  ASSERT_EQ(spheres.size(), 1U);
  EXPECT_NEAR(spheres[0].radius, std::sqrt(3) / 2, 1e-9);
}

TEST(Sphere_collection, a_smooth_surface_is_one_sphere) {
  const auto spheres = spheres_of(sphere(10, 2, {1, 2, 3}));
  ASSERT_EQ(spheres.size(), 1U);
  EXPECT_NEAR(spheres[0].radius, 2, 1e-9);
}

TEST(Sphere_collection, two_distant_spheres_in_one_mesh_are_two_parts) {
  auto mesh = sphere(8, 1, {0, 0, 0});
  append(mesh, sphere(8, 3, {20, 0, 0}));
  const auto spheres = spheres_of(mesh);
  ASSERT_EQ(spheres.size(), 2U);
  EXPECT_NEAR(spheres[0].radius, 1, 1e-9);
  EXPECT_NEAR(spheres[1].radius, 3, 1e-9);
  EXPECT_TRUE(spheres[1].centre.isApprox(Eigen::Vector3d(20, 0, 0), 1e-9));
  // Their counts add up: 14 for the one of the smallest size, 62 for the other.
  EXPECT_EQ(particle_count(spheres, radius_range(Sizes{1, 13})), 14U + 62U);
}

TEST(Sphere_collection, creases_split_a_box_into_its_six_sides) {
  const auto spheres = spheres_of(cube(10));
  ASSERT_EQ(spheres.size(), 6U);
  // Normals turn by 45 degrees or more within two rows of an edge: without those a side reaches from 0.2 to 0.8.
  for (const auto& sphere : spheres) {
    EXPECT_GE(sphere.radius, 0.3 * std::sqrt(2) - 1e-9);
    EXPECT_LE(sphere.radius, 0.5 * std::sqrt(2) + 1e-9);
  }
}

TEST(Sphere_collection, keeps_at_most_the_requested_parts_and_none_below_the_smallest) {
  EXPECT_EQ(spheres_of(cube(10), {.most_parts = 4}).size(), 4U);
  auto mesh = sphere(10);
  append(mesh, sphere(1, 0.1, {5, 0, 0}));  // 6 of 408 vertices
  EXPECT_EQ(spheres_of(mesh, {.smallest_part = 0.02}).size(), 1U);
}

TEST(Sphere_collection, keeps_the_largest_parts_in_the_order_of_their_lowest_vertices) {
  Surface_mesh mesh;
  for (const int size : {6, 8, 5, 9, 7}) append(mesh, sphere(size, size, {20.0 * size, 0, 0}));
  std::vector<double> radii;
  for (const auto& sphere : spheres_of(mesh, {.most_parts = 3})) radii.push_back(std::round(sphere.radius));
  EXPECT_EQ(radii, (std::vector<double>{8, 9, 7}));
}

/// A strip, one unit wide, of `columns` pairs of vertices one unit apart, folded upwards along one of these pairs.
Surface_mesh folded_strip(std::uint32_t columns, std::uint32_t fold, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  auto mesh = grid(columns, 2);
  deform(mesh, [&](const Point& p) {
    const double beyond = std::max(0.0, p.x() - fold);
    return Point(p.x() - beyond + beyond * std::cos(angle), p.y(), beyond * std::sin(angle));
  });
  return mesh;
}

TEST(Sphere_collection, a_vertex_is_critical_if_its_normal_turns_by_more_than_the_angle_of_a_crease) {
  // A vertex of the fold has two faces on one side and one on the other, so its normal is that of 2 m + n. From n it
  // turns by c, where 2 sin(fold - c) = sin c.
  for (const double crease : {20.0, 40.0, 75.0}) {
    const double fold = crease + std::asin(std::sin(crease * std::numbers::pi / 180) / 2) * 180 / std::numbers::pi;
    EXPECT_EQ(spheres_of(folded_strip(21, 8, fold - 0.1), {.crease_degrees = crease}).size(), 1U) << crease;
    const auto parts = spheres_of(folded_strip(21, 8, fold + 0.1), {.crease_degrees = crease});
    ASSERT_EQ(parts.size(), 2U) << crease;
    // Critical are the fold and, on each side of it, the vertex whose neighbour's normal leans to the other side.
    EXPECT_NEAR(parts[0].radius, std::hypot(7, 1) / 2, 1e-9);
    EXPECT_NEAR(parts[1].radius, std::hypot(11, 1) / 2, 1e-9);
  }
}

TEST(Sphere_collection, no_crease_turns_a_normal_by_more_than_180_degrees) {
  // Folded flat onto itself: the normals of a corner of the small face and of its neighbours are opposite.
  auto mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-9, 0, 0}, {-9, 9, 0}}, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}});
  const auto spheres = spheres_of(mesh, {.crease_degrees = 180});
  ASSERT_EQ(spheres.size(), 1U);
  EXPECT_NEAR(spheres[0].radius, bounding_sphere(Numbered_mesh(mesh).positions).radius, 1e-12);
}

TEST(Sphere_collection, a_surface_of_nothing_but_creases_is_one_sphere) {
  const auto spheres = spheres_of(cube(1));
  ASSERT_EQ(spheres.size(), 1U);
  EXPECT_NEAR(spheres[0].radius, std::sqrt(3) / 2, 1e-9);
}

TEST(Sphere_collection, a_surface_without_extent_gives_a_sphere) {
  auto mesh = sphere(2);
  deform(mesh, [](const Point&) { return Point(1, 1, 1); });
  EXPECT_EQ(spheres_of(mesh).size(), 1U);
}

TEST(Particle_count, objects_of_one_size_get_the_kissing_number_or_their_number) {
  const std::vector<Sphere> one{{.radius = 1}};
  EXPECT_EQ(particle_count(one, radius_range(Sizes(20, 1.0))), 12U);
  EXPECT_EQ(particle_count(one, radius_range(Sizes(5, 1.0))), 5U);
  EXPECT_EQ(particle_count(one, radius_range(Sizes{1, 1.04, 1.02})), 3U);  // within equal_sizes
}

TEST(Particle_count, objects_of_different_sizes_are_counted_against_the_smallest) {
  EXPECT_EQ(particle_count(std::vector<Sphere>{{.radius = 3}}, radius_range(Sizes{3, 1})), 62U);
  EXPECT_EQ(particle_count(std::vector<Sphere>{{.radius = 1}}, radius_range(Sizes{3, 1})), 14U);
  EXPECT_EQ(particle_count(std::vector<Sphere>{{.radius = 3}, {.radius = 1}}, radius_range(Sizes{5, 3, 1})), 76U);
}

TEST(Particle_count, stays_within_its_limits_for_any_sizes) {
  EXPECT_EQ(particle_count(std::vector<Sphere>{{.radius = 1000}}, radius_range(Sizes{1000, 1})), 256U);
  EXPECT_EQ(particle_count(std::vector<Sphere>{{.radius = 1e200}}, radius_range(Sizes{1e200, 1e-200})), 256U);
  EXPECT_EQ(particle_count(std::vector<Sphere>(8, {.radius = 1e300}), radius_range(Sizes{1e300, 1e-300})), 256U);
  EXPECT_EQ(particle_count(std::vector<Sphere>{{.radius = 1}}, radius_range(Sizes(20, 1.0)), {.most_particles = 5}),
            5U);
  EXPECT_GE(particle_count(std::vector<Sphere>{{.radius = 0}}, radius_range(Sizes{0, 1})), 1U);
}

TEST(Particle_count, options_out_of_range_are_refused) {
  const std::vector<Sphere> one{{.radius = 1}};
  const Radius_range sizes = radius_range(std::vector<double>{1, 2});
  EXPECT_THROW(particle_count(one, sizes, {.most_particles = 0}), Bad_argument);
  EXPECT_THROW(particle_count(one, sizes, {.equal_sizes = -1}), Bad_argument);
  EXPECT_THROW(spheres_of(cube(2), {.crease_degrees = 0}), Bad_argument);
  EXPECT_THROW(spheres_of(cube(2), {.crease_degrees = 181}), Bad_argument);
  EXPECT_THROW(spheres_of(cube(2), {.smallest_part = 1.5}), Bad_argument);
  EXPECT_THROW(spheres_of(cube(2), {.most_parts = 0}), Bad_argument);
}

TEST(Particle_count, an_ellipsoid_is_no_sphere_and_is_counted_by_its_shadow) {
  auto mesh = sphere(10);
  deform(mesh, [](const Point& p) { return Point(2 * p.x(), p.y(), p.z()); });
  const Numbered_mesh numbered(mesh);
  EXPECT_NEAR(bounding_sphere(numbered.positions).roundness, 0.5, 1e-9);
  const auto spheres = sphere_collection(numbered.graph, numbered.positions, numbered.faces, {});
  ASSERT_EQ(spheres.size(), 1U);
  EXPECT_EQ(particle_count(spheres, radius_range(std::vector<double>(20, spheres[0].radius))), 14U);
}

TEST(Sphere_collection, vertices_without_edges_do_not_count_for_the_share_of_a_part) {
  auto mesh = cube(10);
  for (int i = 0; i < 20'000; ++i) mesh.add_vertex({1000, 0, 0});
  EXPECT_EQ(spheres_of(mesh).size(), 6U);
}

}  // namespace
}  // namespace lodestone
