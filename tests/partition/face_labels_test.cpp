// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/face_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lodestone/mesh/errors.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Labels = std::vector<Region_index>;

Labels labels_of(const Surface_mesh& mesh, const Labels& face_labels) {
  const Numbered_mesh numbered(mesh);
  return vertex_labels({numbered.graph, numbered.positions, numbered.faces}, face_labels);
}

/// Triangles of these areas around vertex 0.
Surface_mesh fan(const std::vector<double>& areas) {
  // Two neighbouring sides of lengths r and s have r s sin(angle) / 2 of area between them.
  constexpr double angle = 0.3;
  std::vector<Point> points{{0, 0, 0}, {1, 0, 0}};
  std::vector<Corners> faces;
  double length = 1;
  for (std::uint32_t i = 0; i < areas.size(); ++i) {
    length = 2 * areas[i] / (length * std::sin(angle));
    points.emplace_back(length * std::cos(angle * (i + 1)), length * std::sin(angle * (i + 1)), 0);
    faces.push_back({0, i + 1, i + 2});
  }
  return mesh_of(points, faces);
}

TEST(Face_labels, a_vertex_gets_the_label_of_most_area_around_it) {
  const auto mesh = fan({1, 1, 3});
  EXPECT_EQ(labels_of(mesh, {5, 5, 2})[0], 2U);
  EXPECT_EQ(labels_of(fan({1, 1, 1.9}), {5, 5, 2})[0], 5U);
}

TEST(Face_labels, between_equal_areas_the_number_of_faces_decides_then_the_lowest_label) {
  // Four squares: the middle vertex has both faces of the first and the last, and one of each other.
  auto mesh = grid(3, 3);
  Labels faces(8, 9);
  faces[0] = faces[1] = 4;
  faces[6] = faces[7] = 3;
  EXPECT_EQ(labels_of(mesh, faces)[4], 3U);
  // Without area only the number of faces decides: three of 9.
  deform(mesh, [](const Point&) { return Point(0, 0, 0); });
  EXPECT_EQ(labels_of(mesh, {4, 9, 9, 9, 9, 9, 3, 3})[4], 9U);
}

TEST(Face_labels, a_label_that_no_vertex_has_most_of_takes_one) {
  const auto mesh = grid(10, 10);
  Labels faces(162, 0);
  faces[80] = 1;
  const auto labels = labels_of(mesh, faces);
  EXPECT_EQ(std::ranges::count(labels, 1U), 1);
  const auto kept = static_cast<std::uint32_t>(std::ranges::find(labels, 1U) - labels.begin());
  const Numbered_mesh numbered(mesh);
  EXPECT_NE(std::ranges::find(numbered.faces[80], kept), numbered.faces[80].end());
}

TEST(Face_labels, a_label_takes_no_vertex_that_is_the_last_of_another) {
  const auto labels = labels_of(tetrahedron(), {0, 1, 2, 3});
  for (Region_index label = 0; label < 4; ++label) EXPECT_EQ(std::ranges::count(labels, label), 1);
  const auto envelope = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  const auto two = labels_of(envelope, {0, 1});
  EXPECT_EQ(std::ranges::count(two, 1U), 1);
}

TEST(Face_labels, vertices_of_faces_without_label_take_the_nearest) {
  const auto mesh = grid(9, 2);
  Labels faces(16, no_region);
  faces[0] = faces[1] = 7;
  faces[14] = faces[15] = 1;
  const auto labels = labels_of(mesh, faces);
  EXPECT_EQ(labels[0], 7U);
  EXPECT_EQ(labels[3], 7U);
  EXPECT_EQ(labels[5], 1U);
  EXPECT_EQ(labels[8], 1U);
}

TEST(Face_labels, vertices_that_no_label_reaches_get_0) {
  auto mesh = grid(3, 2);
  mesh.add_vertex({5, 5, 5});
  append(mesh, grid(2, 2));
  Labels faces(6, no_region);
  faces[0] = 4;
  const auto labels = labels_of(mesh, faces);
  for (std::uint32_t v = 0; v < 6; ++v) EXPECT_EQ(labels[v], 4U);
  for (std::uint32_t v = 6; v < 11; ++v) EXPECT_EQ(labels[v], 0U);
  EXPECT_EQ(labels_of(mesh, Labels(6, no_region)), Labels(11, 0));
}

TEST(Face_labels, a_wrong_number_of_labels_is_refused) {
  EXPECT_THROW(labels_of(tetrahedron(), {0, 1, 2}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
