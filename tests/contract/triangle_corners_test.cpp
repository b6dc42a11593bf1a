// SPDX-License-Identifier: GPL-3.0-or-later
// The corners of faces of every mesh type, from few halfedges.
#include "lodestone/mesh/triangle_corners.h"

#include "contract/mesh_types.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

template <class Mesh>
struct Triangle_corners_contract : ::testing::Test {};
TYPED_TEST_SUITE(Triangle_corners_contract, Mesh_types);

TYPED_TEST(Triangle_corners_contract, are_where_the_three_halfedges_of_a_face_end) {
  for (const auto& source : {potato(4), grid(3, 4), single_triangle()}) {
    const auto mesh = converted<TypeParam>(source);
    const Mesh_numbering<TypeParam> numbering(mesh);
    std::size_t index = 0;
    for (const auto face : faces(mesh)) {
      const auto first = halfedge(face, mesh), second = next(first, mesh), third = next(second, mesh);
      ASSERT_EQ(next(third, mesh), first);
      EXPECT_TRUE(is_triangle(first, mesh));
      const auto [p, q, r] = triangle_corners(first, mesh);
      EXPECT_TRUE(p == target(first, mesh) && q == target(second, mesh) && r == target(third, mesh));
      EXPECT_EQ(numbering.corners()[index++], (Corners{numbering.index(p), numbering.index(q), numbering.index(r)}));
    }
  }
}

TEST(Triangle_corners, a_face_with_more_edges_is_no_triangle) {
  for (const int edges : {4, 5, 9}) {
    Surface_mesh mesh;
    std::vector<Surface_mesh::Vertex_index> corners;
    for (int i = 0; i < edges; ++i) corners.push_back(mesh.add_vertex(Point(i, i * i, 0)));
    const auto face = mesh.add_face(corners);
    EXPECT_FALSE(is_triangle(mesh.halfedge(face), mesh)) << edges;
  }
}

}  // namespace
}  // namespace lodestone
