// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates of every mesh type, as trees read them.
#include "lodestone/mesh/coordinate_reader.h"

#include "contract/mesh_types.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

template <class Mesh>
auto reader_of(const Mesh& mesh) {
  const auto points = get(CGAL::vertex_point, mesh);
  return Coordinate_reader<Mesh, std::remove_const_t<decltype(points)>>(points);
}

/// The coordinates of a mesh by vertex index, from its points.
template <class Mesh>
std::vector<double> expected(const Mesh& mesh, const Mesh_numbering<Mesh>& numbering) {
  const auto points = get(CGAL::vertex_point, mesh);
  std::vector<double> values;
  for (std::uint32_t v = 0; v < numbering.vertex_count(); ++v) {
    const auto p = coordinates(get(points, numbering.vertex(v)));
    values.insert(values.end(), {p.x(), p.y(), p.z()});
  }
  return values;
}

template <class Mesh>
struct Coordinate_reader_contract : ::testing::Test {};
TYPED_TEST_SUITE(Coordinate_reader_contract, Mesh_types);

TYPED_TEST(Coordinate_reader_contract, gives_the_current_positions_of_the_vertices) {
  auto mesh = converted<TypeParam>(as_float(potato(4)));
  const Mesh_numbering<TypeParam> numbering(mesh);
  auto reader = reader_of(mesh);
  auto points = get(CGAL::vertex_point, mesh);
  std::vector<double> before;
  for (int frame = 0; frame < 3; ++frame) {
    const Coordinates read = reader.read(numbering);
    const std::vector now(read.begin(), read.end());
    EXPECT_EQ(now, expected(mesh, numbering));
    EXPECT_NE(now, before);
    before = now;
    for (const auto v : vertices(mesh)) {
      const auto p = coordinates(get(points, v));
      put(points, v, as_float(Point(p.z() + 0.25, 2 * p.x(), p.y())));
    }
  }
}

TEST(Coordinate_reader, of_a_surface_mesh_refers_to_the_mesh_s_own_memory) {
  Surface_mesh mesh = potato(4);
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  auto reader = reader_of(mesh);
  const Coordinates read = reader.read(numbering);
  ASSERT_EQ(read.size(), 3 * mesh.number_of_vertices());
  for (const auto v : mesh.vertices()) EXPECT_EQ(read.data() + 3 * v.idx(), &*mesh.point(v).cartesian_begin());
  mesh.point(Surface_mesh::Vertex_index(7)) = Point(1, 2, 3);
  EXPECT_EQ(read[21], 1);
  EXPECT_EQ(reader.read(numbering).data(), read.data());
}

TEST(Coordinate_reader, copies_points_of_floats_and_points_from_other_maps) {
  using Float_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>;
  Float_mesh floats;
  std::vector<Float_mesh::Vertex_index> made;
  for (int i = 0; i < 3; ++i) made.push_back(floats.add_vertex({0.5F * static_cast<float>(i), 1, 2}));
  floats.add_face(made);
  const Mesh_numbering<Float_mesh> numbering(floats);
  auto reader = reader_of(floats);
  const Coordinates read = reader.read(numbering);
  EXPECT_EQ(std::vector(read.begin(), read.end()), (std::vector<double>{0, 1, 2, 0.5, 1, 2, 1, 1, 2}));

  const Surface_mesh mesh = tetrahedron();
  const auto elsewhere = get(CGAL::dynamic_vertex_property_t<Point>(), mesh);
  for (const auto v : mesh.vertices()) put(elsewhere, v, Point(v.idx(), 5, 6));
  const Mesh_numbering<Surface_mesh> numbers(mesh);
  Coordinate_reader<Surface_mesh, std::remove_const_t<decltype(elsewhere)>> other(elsewhere);
  EXPECT_EQ(other.read(numbers)[9], 3);
  put(elsewhere, Surface_mesh::Vertex_index(3), Point(9, 8, 7));
  EXPECT_EQ(other.read(numbers)[9], 9);
}

}  // namespace
}  // namespace lodestone
