// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/vertex_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

TEST(Vertex_faces, lists_the_faces_with_a_corner_at_each_vertex) {
  for (const auto& mesh : {potato(6), grid(5, 4), cube(3), tetrahedron(), single_triangle()}) {
    const Numbered_mesh numbered(mesh);
    const Vertex_faces vertex_faces(numbered.numbering.vertex_count(), numbered.faces);
    for (std::uint32_t vertex = 0; vertex < numbered.numbering.vertex_count(); ++vertex) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t face = 0; face < numbered.faces.size(); ++face)
        if (std::ranges::find(numbered.faces[face], vertex) != numbered.faces[face].end()) expected.push_back(face);
      const auto found = vertex_faces.at(vertex);
      EXPECT_TRUE(std::ranges::equal(found, expected)) << vertex;
    }
  }
}

TEST(Vertex_faces, a_vertex_without_faces_has_none) {
  const std::vector<Corners> faces{{1, 2, 4}};
  const Vertex_faces vertex_faces(6, faces);
  EXPECT_EQ(vertex_faces.vertex_count(), 6U);
  for (const std::uint32_t vertex : {0U, 3U, 5U}) EXPECT_TRUE(vertex_faces.at(vertex).empty());
  for (const std::uint32_t vertex : {1U, 2U, 4U}) EXPECT_EQ(vertex_faces.at(vertex).size(), 1U);
}

}  // namespace
}  // namespace lodestone
