// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/node_anchors.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/face_soup.h"

namespace lodestone {
namespace {

Eigen::Vector3d position_in(const Face_soup& soup, std::uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3d>(soup.coordinates.data() + 3 * std::size_t{vertex});
}

std::vector<std::uint32_t> vertices_of_node(const Tree_layout& layout, std::uint32_t n) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t leaf = layout.node(n).leaf; leaf < layout.node(n).end_leaf; ++leaf)
    vertices.insert(vertices.end(), layout.vertices(leaf).begin(), layout.vertices(leaf).end());
  return vertices;
}

/// Checks the anchors of all nodes by looking at all vertices of each.
void expect_anchors(const Face_soup& soup, std::size_t leaf_faces) {
  const Tree_layout layout(soup.faces, octants(soup), soup.coordinates, {.leaf_faces = leaf_faces});
  const auto anchors = find_anchors(layout, soup.coordinates);
  ASSERT_EQ(anchors.size(), layout.node_count());
  for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
    const auto vertices = vertices_of_node(layout, n);
    ASSERT_NE(std::ranges::find(vertices, anchors[n].vertex), vertices.end());
    const Eigen::Vector3d anchor = position_in(soup, anchors[n].vertex);
    Eigen::AlignedBox3d box;
    double farthest = 0, nearest = std::numeric_limits<double>::infinity();
    for (const auto vertex : vertices) {
      const auto position = position_in(soup, vertex);
      box.extend(position);
      farthest = std::max(farthest, (position - anchor).norm());
    }
    for (const auto vertex : vertices) nearest = std::min(nearest, (position_in(soup, vertex) - box.center()).norm());
    EXPECT_GE(anchors[n].radius, farthest);
    EXPECT_LE(anchors[n].radius, farthest * (1 + 1e-8));
    EXPECT_LE((anchor - box.center()).norm(), nearest + 1e-12 * box.diagonal().norm());
  }
}

TEST(Node_anchors, are_the_vertex_nearest_to_the_centre_of_a_node_and_the_radius_reaches_all_others) {
  for (const auto& [name, soup] : small_objects())
    for (const std::size_t leaf_faces : {2, 16, 96}) {
      SCOPED_TRACE(name);
      expect_anchors(soup, leaf_faces);
      expect_anchors(placed(soup, 1, 0x1p20), leaf_faces);
      expect_anchors(placed(soup, 1e149), leaf_faces);
    }
}

TEST(Node_anchors, of_faces_that_share_one_point_have_no_radius) {
  const auto soup = placed(small_objects().front().second, 0, 3);
  const Tree_layout layout(soup.faces, octants(soup), soup.coordinates, {.leaf_faces = 8});
  for (const auto& anchor : find_anchors(layout, soup.coordinates)) EXPECT_EQ(anchor.radius, 0);
}

}  // namespace
}  // namespace lodestone
