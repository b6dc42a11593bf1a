// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/feature_vectors.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "support/special_numbers.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

Positions rows(const std::vector<std::array<double, 3>>& points) {
  Positions positions(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    positions.row(static_cast<Eigen::Index>(i)) << points[i][0], points[i][1], points[i][2];
  return positions;
}

TEST(Vertex_normals, are_the_sum_of_the_face_normals_weighted_by_area) {
  // At vertex 0 a face of area 1/2 that looks along z meets one of area 2 that looks along x.
  const auto positions = rows({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 0, 2}});
  const std::vector<Corners> faces{{0, 1, 2}, {0, 3, 4}};
  const auto normals = vertex_normals(positions, faces);
  EXPECT_TRUE(normals.row(0).isApprox(Eigen::RowVector3d(4, 0, 1) / std::sqrt(17.0), 1e-14));
  EXPECT_TRUE(normals.row(1).isApprox(Eigen::RowVector3d(0, 0, 1), 1e-14));
  EXPECT_TRUE(normals.row(4).isApprox(Eigen::RowVector3d(1, 0, 0), 1e-14));
}

TEST(Vertex_normals, of_a_sphere_look_outwards_with_length_1) {
  const Numbered_mesh mesh(sphere(8));
  const auto normals = vertex_normals(mesh.positions, mesh.faces);
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    EXPECT_NEAR(normals.row(v).norm(), 1, 1e-14);
    EXPECT_GT(normals.row(v).dot(mesh.positions.row(v)), 0.98);
  }
}

TEST(Vertex_normals, are_zero_at_isolated_vertices_and_zero_area_faces) {
  const auto positions = rows({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {9, 0, 0}});
  const std::vector<Corners> faces{{0, 1, 2}};
  EXPECT_EQ(vertex_normals(positions, faces), Positions::Zero(4, 3));
}

TEST(Vertex_normals, do_not_depend_on_the_unit) {
  const Numbered_mesh mesh(potato(3));
  const auto normals = vertex_normals(mesh.positions, mesh.faces);
  for (const int exponent : {-400, 400})
    EXPECT_EQ(vertex_normals(mesh.positions * std::ldexp(1.0, exponent), mesh.faces), normals) << exponent;
}

TEST(Feature_vectors, are_positions_in_the_unit_ball_around_the_mean_and_unit_normals) {
  const Numbered_mesh mesh(potato(4));
  const auto features = feature_vectors(mesh.positions, mesh.faces);
  ASSERT_EQ(features.cols(), 6);
  const Positions relative = mesh.positions.rowwise() - mesh.positions.colwise().mean().eval();
  const double largest = relative.rowwise().norm().maxCoeff();
  EXPECT_TRUE(features.leftCols<3>().isApprox(relative / largest, 1e-13));
  EXPECT_NEAR(features.leftCols<3>().rowwise().norm().maxCoeff(), 1, 1e-14);
  EXPECT_TRUE(features.rightCols<3>().isApprox(vertex_normals(mesh.positions, mesh.faces), 1e-13));
}

TEST(Feature_vectors, take_each_factor_times_its_weight) {
  const Numbered_mesh mesh(potato(2));
  const auto plain = feature_vectors(mesh.positions, mesh.faces);
  const auto weighted = feature_vectors(mesh.positions, mesh.faces, {.position_weight = 4, .normal_weight = 0.25});
  EXPECT_EQ(weighted.leftCols<3>(), 4 * plain.leftCols<3>());
  EXPECT_EQ(weighted.rightCols<3>(), 0.25 * plain.rightCols<3>());
}

TEST(Feature_vectors, omit_a_factor_of_weight_0) {
  const Numbered_mesh mesh(potato(2));
  const auto both = feature_vectors(mesh.positions, mesh.faces);
  EXPECT_EQ(feature_vectors(mesh.positions, mesh.faces, {.normal_weight = 0}), both.leftCols<3>());
  EXPECT_EQ(feature_vectors(mesh.positions, mesh.faces, {.position_weight = 0}), both.rightCols<3>());
}

TEST(Feature_vectors, do_not_change_under_a_shift_and_a_scale) {
  const Numbered_mesh mesh(potato(4));
  const auto features = feature_vectors(mesh.positions, mesh.faces);
  const Positions moved = (mesh.positions * 37.5).rowwise() + Eigen::RowVector3d(100, -7, 3);
  EXPECT_TRUE(feature_vectors(moved, mesh.faces).isApprox(features, 1e-12));
  EXPECT_EQ(feature_vectors(mesh.positions * std::ldexp(1.0, -600), mesh.faces), features);
  EXPECT_EQ(feature_vectors(mesh.positions * std::ldexp(1.0, 1000), mesh.faces), features);
}

TEST(Feature_vectors, of_a_mesh_without_extent_are_finite) {
  const auto positions = rows({{3, 3, 3}, {3, 3, 3}, {3, 3, 3}});
  const std::vector<Corners> faces{{0, 1, 2}};
  EXPECT_EQ(feature_vectors(positions, faces), Feature_vectors::Zero(3, 6));
}

TEST(Feature_vectors, weights_below_0_not_finite_or_both_0_are_refused) {
  const Numbered_mesh mesh(tetrahedron());
  for (const auto& [position, normal] : {std::pair{-1.0, 1.0}, {1.0, -0.1}, {nan_value, 1.0}, {1.0, infinity}, {0, 0}})
    EXPECT_THROW(feature_vectors(mesh.positions, mesh.faces, {.position_weight = position, .normal_weight = normal}),
                 Bad_argument);
}

TEST(Factors, are_the_values_of_the_map_times_the_weight) {
  auto mesh = tetrahedron();
  auto number = mesh.add_property_map<Surface_mesh::Vertex_index, int>("v:number").first;
  auto colour = mesh.add_property_map<Surface_mesh::Vertex_index, std::array<float, 3>>("v:colour").first;
  for (const auto v : mesh.vertices()) {
    number[v] = static_cast<int>(v) - 2;
    colour[v] = {1, static_cast<float>(v), 0.5F};
  }
  EXPECT_EQ(factors(mesh, number, 0.5), (Feature_vectors(4, 1) << -1, -0.5, 0, 0.5).finished());
  EXPECT_EQ(factors<3>(mesh, colour, 2), (Feature_vectors(4, 3) << 2, 0, 1, 2, 2, 1, 2, 4, 1, 2, 6, 1).finished());
}

TEST(Factors, bad_weights_and_non_finite_values_are_refused) {
  auto mesh = tetrahedron();
  auto value = mesh.add_property_map<Surface_mesh::Vertex_index, double>("v:value", 1.0).first;
  EXPECT_THROW(factors(mesh, value, -1), Bad_argument);
  EXPECT_THROW(factors(mesh, value, nan_value), Bad_argument);
  EXPECT_THROW(factors(mesh, value, infinity), Bad_argument);
  value[Surface_mesh::Vertex_index(3)] = nan_value;
  EXPECT_THROW(factors(mesh, value), Bad_argument);
}

TEST(Factors, of_a_mesh_with_removed_vertices_are_refused) {
  auto mesh = tetrahedron();
  auto value = mesh.add_property_map<Surface_mesh::Vertex_index, double>("v:value", 1.0).first;
  mesh.remove_vertex(mesh.add_vertex(Point(9, 9, 9)));
  EXPECT_THROW(factors(mesh, value), Bad_mesh);
  mesh.collect_garbage();
  EXPECT_EQ(factors(mesh, value), Feature_vectors::Ones(4, 1));
}

}  // namespace
}  // namespace lodestone
