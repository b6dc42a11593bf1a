// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/surface_report.h"

#include <gtest/gtest.h>

#include <vector>

#include "lodestone/io/shapes/shapes.h"

namespace lodestone::test {
namespace {

const std::vector<Point> tetrahedron_corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Corners> tetrahedron_faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(Surface_report, of_a_tetrahedron_is_closed_and_clean) {
  const auto report = inspect_surface(tetrahedron_corners, tetrahedron_faces);
  EXPECT_EQ(report.vertices, 4U);
  EXPECT_EQ(report.faces, 4U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.border_edges + report.non_manifold_edges + report.degenerate_faces, 0U);
  EXPECT_EQ(report.duplicate_vertices + report.unused_vertices, 0U);
  EXPECT_EQ(report.box.min(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(report.box.max(), Eigen::Vector3d(1, 1, 1));
}

TEST(Surface_report, of_an_open_surface_counts_its_border_edges) {
  const auto report = inspect_surface(tetrahedron_corners, std::span(tetrahedron_faces).first(3));
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.border_edges, 3U);
}

TEST(Surface_report, counts_edges_with_more_than_two_faces) {
  // Three leaves of a book, then four: an even number of faces around its back, but borders elsewhere.
  const std::vector<Point> points{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const std::vector<Corners> leaves{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}};
  for (const std::size_t count : {3U, 4U}) {
    const auto report = inspect_surface(points, std::span(leaves).first(count));
    EXPECT_EQ(report.non_manifold_edges, 1U);
    EXPECT_EQ(report.border_edges, 2 * count);
    EXPECT_EQ(report.unused_vertices, 4 - count);
    EXPECT_FALSE(report.closed);
  }
}

TEST(Surface_report, counts_components_that_touch_without_sharing_a_vertex) {
  auto points = tetrahedron_corners;
  points.insert(points.end(), {{-0.0, 0, 0}, {-1, 0, 0}, {0, -1, 0}});
  auto faces = tetrahedron_faces;
  faces.push_back({4, 5, 6});
  const auto report = inspect_surface(points, faces);
  EXPECT_EQ(report.components, 2U);
  EXPECT_EQ(report.duplicate_vertices, 1U);
}

TEST(Surface_report, counts_zero_area_faces) {
  const std::vector<Point> points{{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}, {1, 0, 0}};
  const std::vector<Corners> faces{{0, 1, 2}, {0, 0, 3}, {3, 3, 3}, {0, 1, 3}};
  const auto report = inspect_surface(points, faces);
  EXPECT_EQ(report.degenerate_faces, 3U);
}

TEST(Surface_report, ignores_unused_vertices_in_the_box) {
  EXPECT_FALSE(inspect_surface({}, {}).closed);
  auto points = tetrahedron_corners;
  points.emplace_back(99, 99, 99);
  const auto report = inspect_surface(points, tetrahedron_faces);
  EXPECT_EQ(report.unused_vertices, 1U);
  EXPECT_EQ(report.box.max(), Eigen::Vector3d(1, 1, 1));
}

TEST(Surface_report, of_built_in_shapes_agrees_with_their_half_edges) {
  for (const auto& mesh : {icosphere(4), cloth(5, 7), teapot({.u = 3, .v = 4})}) {
    std::vector<Point> points(mesh.points().begin(), mesh.points().end());
    std::vector<Corners> faces;
    for (const auto f : mesh.faces()) {
      faces.emplace_back();
      std::size_t corner = 0;
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) faces.back()[corner++] = v;
    }
    std::size_t border = 0;
    for (const auto e : mesh.edges()) border += mesh.is_border(e) ? 1 : 0;
    const auto report = inspect_surface(points, faces);
    EXPECT_EQ(report.border_edges, border);
    EXPECT_EQ(report.closed, border == 0);
    EXPECT_EQ(report.non_manifold_edges, 0U);
  }
}

}  // namespace
}  // namespace lodestone::test
