// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/mesh_numbering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "support/special_numbers.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

// Said by the constraint, not deep inside Boost.
static_assert(!Triangle_mesh<int> && !Triangle_mesh<Surface_mesh*>);
static_assert(Triangle_mesh<Surface_mesh> && !Triangle_mesh<Positions> && !Triangle_mesh<std::vector<Point>> &&
              !Triangle_mesh<std::array<Corners, 2>> && !Triangle_mesh<std::span<const double>>);

TEST(Mesh_numbering, indices_follow_the_order_of_the_mesh_and_map_back_to_its_vertices) {
  const auto mesh = sphere(3);
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  ASSERT_EQ(numbering.vertex_count(), num_vertices(mesh));
  std::uint32_t expected = 0;
  for (const auto v : vertices(mesh)) {
    EXPECT_EQ(numbering.index(v), expected);
    EXPECT_EQ(numbering.vertex(expected), v);
    ++expected;
  }
}

TEST(Mesh_numbering, corners_are_those_of_the_faces_in_their_order_and_orientation) {
  const std::vector<Corners> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const auto mesh = tetrahedron();
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  ASSERT_EQ(numbering.corners().size(), faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Corners turned = numbering.corners()[f];
    for (int i = 0; i < 3 && turned[0] != faces[f][0]; ++i) turned = {turned[1], turned[2], turned[0]};
    EXPECT_EQ(turned, faces[f]);
  }
}

TEST(Mesh_numbering, a_mesh_without_faces_is_refused) {
  Surface_mesh mesh;
  EXPECT_THROW(Mesh_numbering<Surface_mesh>{mesh}, Bad_mesh);
  mesh.add_vertex({0, 0, 0});
  EXPECT_THROW(Mesh_numbering<Surface_mesh>{mesh}, Bad_mesh);
}

TEST(Mesh_numbering, a_face_that_is_not_a_triangle_is_refused_with_its_index) {
  auto mesh = single_triangle();
  std::vector<Surface_mesh::Vertex_index> corners;
  for (const auto& p : {Point(5, 0, 0), Point(6, 0, 0), Point(6, 1, 0), Point(5, 1, 0)})
    corners.push_back(mesh.add_vertex(p));
  mesh.add_face(corners);
  try {
    const Mesh_numbering<Surface_mesh> numbering(mesh);
    FAIL() << "a quadrilateral was taken";
  } catch (const Bad_mesh& error) {
    EXPECT_NE(std::string(error.what()).find("face 1"), std::string::npos) << error.what();
  }
}

TEST(Mesh_numbering, a_mesh_with_removed_elements_is_refused_until_garbage_is_collected) {
  auto mesh = sphere(2);
  CGAL::Euler::remove_face(mesh.halfedge(*mesh.faces().begin()), mesh);
  EXPECT_THROW(Mesh_numbering<Surface_mesh>{mesh}, Bad_mesh);
  mesh.collect_garbage();
  EXPECT_EQ(Mesh_numbering<Surface_mesh>(mesh).corners().size(), 8 * 2 * 2 - 1);
}

TEST(Mesh_numbering, is_the_same_for_any_number_of_workers) {
  const auto mesh = icosphere(60);
  const Mesh_numbering<Surface_mesh> alone(mesh);
  for (const std::size_t threads : {2, 3, 8}) {
    Workers workers(threads);
    const Mesh_numbering<Surface_mesh> shared(mesh, workers);
    EXPECT_EQ(shared.vertex_count(), alone.vertex_count());
    EXPECT_TRUE(std::ranges::equal(shared.corners(), alone.corners()));
  }
}

TEST(Mesh_numbering, names_the_first_face_that_is_not_a_triangle_for_any_number_of_workers) {
  auto mesh = icosphere(60);
  for (const std::uint32_t face : {70'000, 40'000}) {
    const auto inner = CGAL::Euler::add_center_vertex(mesh.halfedge(Surface_mesh::Face_index(face)), mesh);
    CGAL::Euler::join_face(inner, mesh);  // of the three new faces two are a quadrangle now
  }
  mesh.collect_garbage();
  const auto message = [&](std::size_t threads) -> std::string {
    Workers workers(threads);
    try {
      Mesh_numbering<Surface_mesh>(mesh, workers);
    } catch (const Bad_mesh& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(1), "");
  for (const std::size_t threads : {2, 3, 8}) EXPECT_EQ(message(threads), message(1));
}

TEST(Mesh_numbering, positions_come_from_the_given_map) {
  auto mesh = tetrahedron();
  auto other = mesh.add_property_map<Surface_mesh::Vertex_index, Point>("v:other").first;
  for (const auto v : mesh.vertices()) other[v] = Point(v, 2 * v, -1.5);
  const auto positions = read_positions(Mesh_numbering<Surface_mesh>(mesh), other);
  ASSERT_EQ(positions.rows(), 4);
  for (int v = 0; v < 4; ++v) EXPECT_EQ(positions.row(v), Eigen::RowVector3d(v, 2 * v, -1.5));
}

TEST(Mesh_numbering, a_non_finite_coordinate_is_refused_with_its_vertex_index) {
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()})
    for (int axis = 0; axis < 3; ++axis) {
      auto mesh = tetrahedron();
      std::array<double, 3> p{0, 0, 0};
      p[axis] = bad;
      mesh.point(Surface_mesh::Vertex_index(2)) = Point(p[0], p[1], p[2]);
      try {
        read_positions(Mesh_numbering<Surface_mesh>(mesh), mesh.points());
        FAIL() << bad << " was taken";
      } catch (const Bad_mesh& error) {
        EXPECT_NE(std::string(error.what()).find("vertex 2"), std::string::npos) << error.what();
      }
    }
}

}  // namespace
}  // namespace lodestone
