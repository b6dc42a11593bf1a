// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/exhaustive.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "lodestone/triangles/triangle_intersection.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

std::vector<Face_pair> double_loop(const Surface_mesh& a, const Surface_mesh& b) {
  const auto triangle = [](const Surface_mesh& mesh, Surface_mesh::Face_index face) {
    const auto h = mesh.halfedge(face);
    return Triangle{mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h)))};
  };
  std::vector<Face_pair> pairs;
  for (const auto i : a.faces())
    for (const auto j : b.faces())
      if (triangles_intersect(triangle(a, i), triangle(b, j))) pairs.push_back({i, j});
  return pairs;
}

TEST(Exhaustive, equals_the_double_loop) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-2, 2);
  const auto a = potato(5);
  std::size_t found = 0;
  for (int trial = 0; trial < 12; ++trial) {
    auto b = potato(4, 2);
    shift(b, offset(random), offset(random), offset(random));
    const auto expected = double_loop(a, b);
    EXPECT_EQ(exhaustive_face_pairs(a, b), expected);
    found += expected.size();
  }
  EXPECT_GT(found, 50U);
}

TEST(Exhaustive, counts_touching_and_zero_area_faces) {
  auto above = grid(4, 4);
  auto folded = grid(4, 4);
  deform(folded, [](const Point& p) { return Point(p.x(), 1, p.y() - 1); });  // standing on a row of vertices
  auto collapsed = grid(4, 4);
  deform(collapsed, [](const Point& p) { return Point(p.x(), 0, p.y() - 1); });
  for (const auto v : collapsed.vertices()) collapsed.point(v) = Point(collapsed.point(v).x(), 0, 0);
  for (const auto* other : {&above, &folded, &collapsed}) {
    const auto expected = double_loop(above, *other);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(exhaustive_face_pairs(above, *other), expected);
  }
}

TEST(Exhaustive, lists_the_index_in_the_first_mesh_first) {
  const auto one = single_triangle();
  auto many = grid(3, 3);
  shift(many, -1.9, -1.9, 0);  // only the last square reaches over the origin
  const auto pairs = exhaustive_face_pairs(one, many);
  EXPECT_EQ(pairs, (std::vector<Face_pair>{{0, 6}, {0, 7}}));
}

TEST(Exhaustive, reads_positions_through_the_given_maps) {
  auto a = potato(3), b = potato(3);
  const auto expected = exhaustive_face_pairs(a, b);
  auto points = b.add_property_map<Surface_mesh::Vertex_index, Point>("v:other").first;
  for (const auto v : b.vertices()) points[v] = b.point(v);
  shift(b, 100);
  EXPECT_TRUE(exhaustive_face_pairs(a, b).empty());
  EXPECT_EQ(exhaustive_face_pairs(a, b, CGAL::parameters::default_values(), CGAL::parameters::vertex_point_map(points)),
            expected);
}

TEST(Exhaustive, refuses_bad_meshes) {
  auto mesh = potato(2);
  EXPECT_THROW(exhaustive_face_pairs(mesh, Surface_mesh()), Bad_mesh);
  auto broken = mesh;
  broken.point(Surface_mesh::Vertex_index(3)) = Point(0, 0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(exhaustive_face_pairs(mesh, broken), Bad_mesh);
  EXPECT_THROW(exhaustive_face_pairs(broken, mesh), Bad_mesh);
}

}  // namespace
}  // namespace lodestone
