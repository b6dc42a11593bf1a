// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/faces_in_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "support/instruction_sets.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Points = Surface_mesh::Property_map<Surface_mesh::Vertex_index, Point>;
using Reader = Box_reader<Surface_mesh, Points>;

Box box_of(const Numbered_mesh& mesh, std::uint32_t face) {
  Box box;
  for (const auto corner : mesh.faces[face]) box.extend(mesh.positions.row(corner).transpose());
  return box;
}

/// The faces in a box, by the definition.
std::vector<std::uint32_t> expected_faces(const Surface_mesh& mesh, const Box& part) {
  const Numbered_mesh numbered(mesh);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t face = 0; face < numbered.faces.size(); ++face)
    if (box_of(numbered, face).intersects(part)) expected.push_back(face);
  return expected;
}

std::vector<Box> boxes_for(const Surface_mesh& mesh) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> at(-1.5, 1.5);
  const auto point = [&] { return Eigen::Vector3d(at(random), at(random), at(random)); };
  std::vector<Box> boxes{Box(Eigen::Vector3d(-9, -9, -9), Eigen::Vector3d(9, 9, 9)),
                         Box(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6))};
  for (const auto v : mesh.vertices()) {  // touches faces in one corner of the box
    const Eigen::Vector3d corner = coordinates(mesh.point(v));
    boxes.emplace_back(corner, corner + Eigen::Vector3d(1, 1, 1));
    if (boxes.size() > 30) break;
  }
  for (int i = 0; i < 100; ++i) boxes.push_back(Box(point()).extend(point()));
  return boxes;
}

TEST(Faces_in_box, are_those_whose_boxes_meet_it) {
  for (const auto& mesh : {potato(6), sphere(7), grid(5, 4), cube(3), tetrahedron(), single_triangle()})
    for (const Box& part : boxes_for(mesh))
      for_instruction_sets([&] {
        Reader reader(mesh, mesh.points());
        Faces_in_box found;
        ASSERT_TRUE(reader.read_positions());
        ASSERT_TRUE(reader.read_faces(part, found));
        EXPECT_TRUE(std::ranges::equal(found.faces, expected_faces(mesh, part)));
        const Numbered_mesh numbered(mesh);
        ASSERT_EQ(found.corners.size(), found.faces.size());
        for (std::size_t i = 0; i < found.faces.size(); ++i)
          EXPECT_EQ(found.corners[i], numbered.faces[found.faces[i]]);
      });
}

TEST(Faces_in_box, are_found_in_meshes_that_are_read_block_by_block) {
  const auto mesh = sphere(30);
  ASSERT_GT(mesh.number_of_faces(), 5000);
  Reader reader(mesh, mesh.points());
  ASSERT_TRUE(reader.read_positions());
  for (const Box& part : boxes_for(mesh)) {
    Faces_in_box found;
    ASSERT_TRUE(reader.read_faces(part, found));
    EXPECT_TRUE(std::ranges::equal(found.faces, expected_faces(mesh, part)));
    EXPECT_EQ(found.corners.size(), found.faces.size());
  }
}

TEST(Faces_in_box, of_a_part_are_selected_from_those_of_the_whole) {
  const auto mesh = potato(6);
  Reader reader(mesh, mesh.points());
  Faces_in_box all;
  ASSERT_TRUE(reader.read_positions());
  ASSERT_TRUE(reader.read_faces(reader.box(), all));
  EXPECT_EQ(all.faces.size(), mesh.number_of_faces());
  for (const Box& part : boxes_for(mesh)) {
    Faces_in_box found;
    select_faces(all, part, found);
    EXPECT_TRUE(std::ranges::equal(found.faces, expected_faces(mesh, part)));
  }
}

TEST(Box_reader, bounds_all_positions) {
  for (const auto& mesh : {potato(6), sphere(2), grid(5, 4), tetrahedron(), single_triangle()}) {
    Box expected;
    for (const auto v : mesh.vertices()) expected.extend(coordinates(mesh.point(v)));
    for_instruction_sets([&] {
      Reader reader(mesh, mesh.points());
      ASSERT_TRUE(reader.read_positions());
      EXPECT_EQ(reader.box().min(), expected.min());
      EXPECT_EQ(reader.box().max(), expected.max());
    });
  }
}

/// Vectors begin where cache lines do, so that what is read first and last depends on where the coordinates lie.
TEST(Box_reader, bounds_positions_wherever_in_memory_they_begin) {
  constexpr std::size_t most = 40, offsets = 8;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<double> memory(offsets + 3 * most);
  std::ranges::generate(memory, [&] { return number(random); });
  for_instruction_sets([&] {
    for (std::size_t offset = 0; offset < offsets; ++offset)
      for (std::size_t count = 1; count <= most; ++count) {
        const std::span coordinates = std::span(memory).subspan(offset, 3 * count);
        Box expected, box;
        for (std::size_t i = 0; i < coordinates.size(); i += 3)
          expected.extend(Eigen::Vector3d(coordinates[i], coordinates[i + 1], coordinates[i + 2]));
        ASSERT_TRUE(bound_positions(coordinates, box));
        ASSERT_EQ(box.min(), expected.min()) << offset << ' ' << count;
        ASSERT_EQ(box.max(), expected.max()) << offset << ' ' << count;
        for (double& coordinate : coordinates) {
          const double before = std::exchange(coordinate, std::numeric_limits<double>::quiet_NaN());
          ASSERT_FALSE(bound_positions(coordinates, box)) << offset << ' ' << count;
          coordinate = before;
        }
      }
  });
}

TEST(Box_reader, refuses_a_coordinate_that_is_not_finite_wherever_it_is) {
  auto mesh = potato(3);
  for (const auto v : mesh.vertices())
    for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()})
      for (int axis = 0; axis < 3; ++axis) {
        const Point before = mesh.point(v);
        std::array<double, 3> p{before.x(), before.y(), before.z()};
        p[axis] = bad;
        mesh.point(v) = Point(p[0], p[1], p[2]);
        for_instruction_sets(
            [&] { EXPECT_FALSE(Reader(mesh, mesh.points()).read_positions()) << v << ' ' << axis << ' ' << bad; });
        mesh.point(v) = before;
      }
  EXPECT_TRUE(Reader(mesh, mesh.points()).read_positions());
}

TEST(Box_reader, accepts_the_largest_coordinates) {
  constexpr double most = std::numeric_limits<double>::max();
  const auto mesh = mesh_of({{most, most, most}, {most, -most, 0}, {most, 0, most}}, {{0, 1, 2}});
  EXPECT_TRUE(Reader(mesh, mesh.points()).read_positions());
}

TEST(Box_reader, refuses_a_mesh_without_faces_and_one_with_removed_elements) {
  const Surface_mesh empty;
  EXPECT_FALSE(Reader(empty, empty.points()).read_positions());
  auto removed = potato(3);
  CGAL::Euler::remove_face(removed.halfedge(*removed.faces().begin()), removed);
  EXPECT_FALSE(Reader(removed, removed.points()).read_positions());
}

TEST(Box_reader, refuses_a_face_that_is_no_triangle_inside_and_outside_of_the_box) {
  Surface_mesh mesh = tetrahedron();
  std::vector<Surface_mesh::Vertex_index> corners;
  for (const auto& p : {Point(10, 0, 0), Point(11, 0, 0), Point(11, 1, 0), Point(10, 1, 0)})
    corners.push_back(mesh.add_vertex(p));
  mesh.add_face(corners);
  Reader reader(mesh, mesh.points());
  ASSERT_TRUE(reader.read_positions());
  for (const Box& part : {Box(), Box(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1)), reader.box()}) {
    Faces_in_box found;
    EXPECT_FALSE(reader.read_faces(part, found));
  }
}

TEST(Box_reader, refuses_a_face_of_more_than_three_edges) {
  for (int edges = 4; edges < 40; ++edges) {
    Surface_mesh mesh = single_triangle();
    std::vector<Surface_mesh::Vertex_index> corners;
    for (int i = 0; i < edges; ++i) corners.push_back(mesh.add_vertex(Point(i, i * i, 0)));
    mesh.add_face(corners);
    Reader reader(mesh, mesh.points());
    ASSERT_TRUE(reader.read_positions());
    Faces_in_box found;
    EXPECT_FALSE(reader.read_faces(reader.box(), found)) << edges;
  }
}

TEST(Box_reader, refuses_a_quadrilateral_that_a_face_of_two_edges_makes_up_for) {
  Surface_mesh mesh;
  CGAL::make_tetrahedron(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), mesh);
  CGAL::Euler::join_face(*mesh.halfedges().begin(), mesh);  // a quadrilateral and two triangles
  mesh.collect_garbage();
  auto h = *mesh.halfedges().begin();
  while (mesh.degree(mesh.face(h)) != 3) h = mesh.opposite(mesh.next(h));
  CGAL::Euler::split_face(mesh.prev(h), h, mesh);  // doubles an edge
  ASSERT_EQ(mesh.number_of_halfedges(), 3 * mesh.number_of_faces());
  Reader reader(mesh, mesh.points());
  ASSERT_TRUE(reader.read_positions());
  Faces_in_box found;
  EXPECT_FALSE(reader.read_faces(reader.box(), found));
}

TEST(Box_reader, of_an_empty_box_checks_the_faces_of_closed_and_of_open_surfaces) {
  for (const auto& mesh : {potato(3), grid(4, 4)}) {
    Reader reader(mesh, mesh.points());
    ASSERT_TRUE(reader.read_positions());
    Faces_in_box found;
    EXPECT_TRUE(reader.read_faces(Box(), found));
    EXPECT_TRUE(found.faces.empty());
  }
  Surface_mesh box;  // closed, with quadrilaterals
  CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 1, 1), Point(0, 0, 1),
                        Point(1, 0, 1), Point(1, 1, 1), box);
  Reader reader(box, box.points());
  ASSERT_TRUE(reader.read_positions());
  Faces_in_box found;
  EXPECT_FALSE(reader.read_faces(Box(), found));
}

}  // namespace
}  // namespace lodestone
