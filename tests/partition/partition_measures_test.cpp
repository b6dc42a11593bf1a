// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/partition_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lodestone/mesh/errors.h"
#include "lodestone/partition/lbg.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// A partition given by its labels, with the lowest vertex of each region as its particle.
Numbered_partition given(std::vector<Region_index> labels, std::size_t regions) {
  Numbered_partition partition{.labels = std::move(labels), .regions = regions, .particles = {}, .statistics = {}};
  for (Region_index region = 0; region < regions; ++region)
    partition.particles.push_back(
        static_cast<std::uint32_t>(std::ranges::find(partition.labels, region) - partition.labels.begin()));
  partition.statistics.repair.parts_before = regions;
  return partition;
}

Partition_measures measured(const Surface_mesh& mesh, const Numbered_partition& partition) {
  const Numbered_mesh numbered(mesh);
  return measure_partition({numbered.graph, numbered.positions, numbered.numbering.corners()}, partition);
}

/// A flat grid of 6 x 4 vertices, its left three columns in region 0, the right three in region 1.
std::vector<Region_index> halves() {
  std::vector<Region_index> labels;
  for (int v = 0; v < 24; ++v) labels.push_back(v % 6 < 3 ? 0 : 1);
  return labels;
}

TEST(Partition_measures, a_grid_cut_in_the_middle_has_the_figures_of_its_halves) {
  const auto m = measured(grid(6, 4), given(halves(), 2));
  // Offsets from the middle: x in +-0.5, 1.5, 2.5 and y in +-0.5, 1.5; the radius is that of the corner.
  const double radius = std::hypot(2.5, 1.5);
  EXPECT_EQ(m.regions, 2U);
  EXPECT_DOUBLE_EQ(m.size_balance, 1);
  EXPECT_DOUBLE_EQ(m.parts_per_region, 1);
  // Each half: x varies by -1, 0, 1 around its mean, y by +-0.5, +-1.5.
  EXPECT_NEAR(m.distortion, (2.0 / 3 + 1.25) / (radius * radius) / 6, 1e-12);
  // The border runs through three squares, straight up; the area is 15.
  EXPECT_NEAR(m.border_length, 3 / std::sqrt(15.0), 1e-12);
  EXPECT_NEAR(m.normal_deviation, 0, 1e-9);
  EXPECT_EQ(m.box_volume, 0);
  // From vertex 0 to (2, 3): two diagonals and a side; from vertex 3 likewise.
  EXPECT_NEAR(m.geodesic_radius, (2 * std::sqrt(2.0) + 1) / radius, 1e-12);
  // The faces of a half reach over the border: 4 x 4 vertices of extent 3 x 3.
  EXPECT_NEAR(m.ball_volume, 2 * std::pow(std::sqrt(4.5) / radius, 3), 1e-9);
}

TEST(Partition_measures, a_border_between_three_regions_meets_in_the_middle_of_the_face) {
  const auto m = measured(single_triangle(), given({0, 1, 2}, 3));
  // From the centroid (1/3, 1/3) to the middles of the sides; the area is 1/2.
  const double border = 2 * std::hypot(1.0 / 6, 1.0 / 3) + std::hypot(1.0 / 6, 1.0 / 6);
  EXPECT_NEAR(m.border_length, border / std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(m.distortion, 0, 1e-15);
}

TEST(Partition_measures, normals_of_a_whole_sphere_deviate_as_they_do_from_any_axis_or_more) {
  // Two hemispheres: the angle to the pole has density sin; the mean of its square over the hemisphere is pi - 2.
  const auto mesh = sphere(40);
  std::vector<Region_index> labels;
  for (const auto v : mesh.vertices()) labels.push_back(mesh.point(v).z() > 0 ? 0 : 1);
  const auto m = measured(mesh, given(std::move(labels), 2));
  EXPECT_NEAR(m.normal_deviation, std::sqrt(std::numbers::pi - 2) * 180 / std::numbers::pi, 1.0);
  EXPECT_NEAR(m.box_volume, 1, 0.05);
  EXPECT_NEAR(m.ball_volume, 2, 0.1);
}

/// The area vectors of a closed region cancel out, but for rounding: no direction is nearer than another.
TEST(Partition_measures, of_a_closed_region_have_a_right_angle_to_every_normal) {
  for (const double at : {0.0, 0.1, 1e3}) {
    auto mesh = cube(4);
    for (const auto v : mesh.vertices()) mesh.point(v) = mesh.point(v) + Kernel::Vector_3(at, 0.3 * at, 0.7 * at);
    const auto m = measured(mesh, given(std::vector<Region_index>(mesh.number_of_vertices(), 0), 1));
    EXPECT_DOUBLE_EQ(m.normal_deviation, 90);
  }
}

TEST(Partition_measures, the_balance_reflects_a_larger_region_and_islands_are_counted_before_repair) {
  auto labels = halves();
  for (int v = 0; v < 24; ++v) labels[v] = v < 18 ? 0 : 1;
  auto partition = given(labels, 2);
  partition.statistics.repair.parts_before = 5;
  const auto m = measured(grid(6, 4), partition);
  EXPECT_DOUBLE_EQ(m.size_balance, 1.5);
  EXPECT_DOUBLE_EQ(m.parts_per_region, 2.5);
}

TEST(Partition_measures, do_not_depend_on_units_or_position) {
  auto mesh = potato(6);
  const Numbered_mesh numbered(mesh);
  const Partition_input<Surface_mesh> input{mesh, numbered.numbering, numbered.graph, numbered.positions};
  const auto partition = partition_numbered(input, 9, Lbg{});
  const auto before = measured(mesh, partition);
  for (const double scale : {std::ldexp(1.0, 300), std::ldexp(1.0, -300)}) {
    auto scaled = mesh;
    for (const auto v : scaled.vertices()) {
      const auto& p = mesh.point(v);
      scaled.point(v) = Point(scale * p.x(), scale * p.y(), scale * p.z());
    }
    const auto after = measured(scaled, partition);
    EXPECT_NEAR(after.distortion, before.distortion, 1e-9);
    EXPECT_NEAR(after.border_length, before.border_length, 1e-9);
    EXPECT_NEAR(after.normal_deviation, before.normal_deviation, 1e-6);
    EXPECT_NEAR(after.geodesic_radius, before.geodesic_radius, 1e-9);
    EXPECT_NEAR(after.box_volume, before.box_volume, 1e-9);
    EXPECT_NEAR(after.ball_volume, before.ball_volume, 1e-9);
  }
}

TEST(Partition_measures, of_a_mesh_equal_those_of_its_positions_and_faces) {
  auto mesh = potato(6);
  const auto regions = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;
  const auto result = partition(mesh, 9, regions, Lbg{});
  const auto m = measure_partition(mesh, result, regions);
  const Numbered_mesh numbered(mesh);
  const Partition_input<Surface_mesh> input{mesh, numbered.numbering, numbered.graph, numbered.positions};
  const auto expected = measured(mesh, partition_numbered(input, 9, Lbg{}));
  EXPECT_EQ(m.distortion, expected.distortion);
  EXPECT_EQ(m.geodesic_radius, expected.geodesic_radius);
  EXPECT_EQ(m.parts_per_region, expected.parts_per_region);
}

TEST(Partition_measures, surfaces_without_extent_have_finite_measures) {
  const auto m = measured(mesh_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}), given({0, 0, 0}, 1));
  for (const double figure :
       {m.distortion, m.border_length, m.normal_deviation, m.geodesic_radius, m.box_volume, m.ball_volume})
    EXPECT_EQ(figure, 0);
}

TEST(Partition_measures, partitions_of_another_surface_are_refused) {
  EXPECT_THROW(measured(grid(6, 4), given({0, 1}, 2)), Bad_argument);
  auto partition = given(halves(), 2);
  partition.particles.pop_back();
  EXPECT_THROW(measured(grid(6, 4), partition), Bad_argument);
  partition = given(halves(), 2);
  partition.labels[3] = 7;
  EXPECT_THROW(measured(grid(6, 4), partition), Bad_argument);
}

TEST(Partition_measures, a_region_without_vertices_is_refused) {
  auto partition = given({0, 0, 1, 1}, 2);
  partition.regions = 3;
  partition.particles = {0, 2, 2};
  EXPECT_THROW(measured(grid(2, 2), partition), Bad_argument);
}

TEST(Partition_measures, a_particle_outside_its_region_is_refused) {
  auto partition = given({0, 0, 1, 1}, 2);
  EXPECT_NO_THROW(measured(grid(2, 2), partition));
  partition.particles = {0, 1};
  EXPECT_THROW(measured(grid(2, 2), partition), Bad_argument);
}

TEST(Partition_measures, a_region_or_particle_at_vertices_without_faces_only_is_refused) {
  auto mesh = grid(2, 2);
  mesh.add_vertex({9, 9, 9});
  EXPECT_THROW(measured(mesh, given({0, 0, 1, 1, 2}, 3)), Bad_argument);
  auto partition = given({0, 0, 1, 1, 1}, 2);
  EXPECT_NO_THROW(measured(mesh, partition));
  partition.particles[1] = 4;
  EXPECT_THROW(measured(mesh, partition), Bad_argument);
}

TEST(Partition_measures, a_face_counts_for_the_region_of_each_of_its_corners) {
  // Two squares at a right angle, one column of vertices in region 0, two in region 1: region 1 has three corners of
  // the first square and six of the second, so its mean normal is atan(2) from the one and atan(1/2) from the other.
  auto mesh = grid(3, 2);
  deform(mesh, [](const Point& p) { return p.x() > 1.5 ? Point(1, p.y(), 1) : p; });
  const auto m = measured(mesh, given({0, 1, 1, 0, 1, 1}, 2));
  const double from_first = std::atan(2.0), from_second = std::atan(0.5);
  const double mean_square = (3 * from_first * from_first + 6 * from_second * from_second) / 12;
  EXPECT_NEAR(m.normal_deviation, std::sqrt(mean_square) * 180 / std::numbers::pi, 1e-9);
}

TEST(Partition_measures, no_path_of_a_geodesic_radius_leaves_its_region) {
  // Region 1 is a wall into a grid of 3 x 5 vertices; region 0 goes round its end.
  std::vector<Region_index> labels(15, 0);
  for (const std::size_t v : {1, 4, 7, 10}) labels[v] = 1;
  const auto m = measured(grid(3, 5), given(std::move(labels), 2));
  // Three steps up, one along the diagonal, one right, four down; the farthest vertex is sqrt(5) from the mean.
  const double round_the_wall = 3 + std::sqrt(2) + 1 + 4, along_the_wall = 3;
  EXPECT_NEAR(m.geodesic_radius, (round_the_wall + along_the_wall) / 2 / std::sqrt(5), 1e-12);
}

}  // namespace
}  // namespace lodestone
