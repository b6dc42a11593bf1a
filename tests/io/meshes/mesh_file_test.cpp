// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/meshes/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Face_of_points = std::multiset<std::size_t>;

/// Per face of the mesh, in order: its corners as file vertices.
std::vector<Face_of_points> file_corners(const Mesh_file& read) {
  std::vector<Face_of_points> result;
  for (const auto face : faces(read.mesh)) {
    result.emplace_back();
    for (const auto v : vertices_around_face(halfedge(face, read.mesh), read.mesh))
      result.back().insert(read.file_vertex.at(v));
  }
  return result;
}

void expect_square(const Mesh_file& read) {
  EXPECT_EQ(read.file_vertices, 4U);
  EXPECT_EQ(file_corners(read), (std::vector<Face_of_points>{{0, 1, 2}, {0, 2, 3}}));
  const std::vector<Point> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const auto v : vertices(read.mesh)) EXPECT_EQ(read.mesh.point(v), corners.at(read.file_vertex.at(v)));
}

/// Checks what must hold for every mesh that was read.
void expect_sound(const Mesh_file& read) {
  EXPECT_TRUE(read.mesh.is_valid(false));
  EXPECT_EQ(read.file_vertex.size(), num_vertices(read.mesh));
  for (const auto v : vertices(read.mesh)) {
    EXPECT_FALSE(read.mesh.is_isolated(v));
    EXPECT_LT(read.file_vertex.at(v), read.file_vertices);
  }
}

class Mesh_reading : public testing::Test {
 protected:
  Mesh_file read(const std::string& name, std::string_view bytes) const {
    auto result = read_mesh(folder.write(name, bytes));
    expect_sound(result);
    return result;
  }

  /// Reads an OFF file of these faces over `vertex_count` points on a curve, no three of them on a line.
  Mesh_file read_faces(std::size_t vertex_count, const std::vector<std::array<int, 3>>& triangles) const {
    auto text = "OFF\n" + std::to_string(vertex_count) + ' ' + std::to_string(triangles.size()) + " 0\n";
    for (std::size_t i = 0; i < vertex_count; ++i)
      text += std::to_string(i) + ' ' + std::to_string(i * i) + ' ' + std::to_string(i * i * i) + '\n';
    for (const auto& [a, b, c] : triangles)
      text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
    auto result = read("faces.off", text);
    std::vector<Face_of_points> expected;
    expected.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles)
      expected.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
    EXPECT_EQ(file_corners(result), expected) << "face i of the mesh is the i-th face of the file";
    for (const auto v : vertices(result.mesh)) {
      const double i = result.file_vertex.at(v);
      EXPECT_EQ(result.mesh.point(v), Point(i, i * i, i * i * i));
    }
    return result;
  }

  Temporary_folder folder;
};

TEST_F(Mesh_reading, gives_the_same_mesh_from_every_format) {
  for (const auto& [name, bytes] : all_squares()) {
    SCOPED_TRACE(name);
    expect_square(read(name, bytes));
  }
}

TEST_F(Mesh_reading, accepts_extensions_in_capitals) { expect_square(read("SQUARE.OFF", square_off)); }

TEST_F(Mesh_reading, accepts_windows_line_ends_in_text) {
  for (auto [name, bytes] : all_squares()) {
    if (bytes.find('\0') != std::string::npos) continue;
    SCOPED_TRACE(name);
    for (std::size_t at = 0; (at = bytes.find('\n', at)) != std::string::npos; at += 2) bytes.insert(at, 1, '\r');
    expect_square(read(name, bytes));
  }
}

TEST_F(Mesh_reading, accepts_a_byte_order_mark_in_text) {
  for (auto [name, bytes] : all_squares()) {
    if (bytes.find('\0') != std::string::npos) continue;
    SCOPED_TRACE(name);
    expect_square(read(name, "\xEF\xBB\xBF" + bytes));
  }
}

TEST_F(Mesh_reading, accepts_text_without_a_final_line_end) {
  for (auto [name, bytes] : all_squares())
    if (bytes.back() == '\n') {
      SCOPED_TRACE(name);
      bytes.pop_back();
      expect_square(read(name, bytes));
    }
}

TEST_F(Mesh_reading, prints_nothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (const auto& [name, bytes] : all_squares()) read(name, bytes);
  EXPECT_THROW(read("broken.off", "OFF\n3 1 0\n0 0 0\n"), Bad_mesh);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(Mesh_reading, keeps_every_bit_of_a_coordinate) {
  const std::string coordinates = "0.1 1e308 -4.9406564584124654e-324";
  const auto mesh = read("bits.off", "OFF\n3 1 0\n" + coordinates + "\n0 0 0\n+1 -1. .5\n3 0 1 2\n").mesh;
  EXPECT_EQ(mesh.point(Surface_mesh::Vertex_index(0)), Point(0.1, 1e308, -4.9406564584124654e-324));
  EXPECT_EQ(mesh.point(Surface_mesh::Vertex_index(2)), Point(1, -1, 0.5));
}

TEST_F(Mesh_reading, keeps_the_order_of_faces_for_any_connectivity) {
  read_faces(7, {{4, 5, 6}, {0, 1, 2}, {2, 1, 3}, {6, 5, 3}});
}

TEST_F(Mesh_reading, accepts_a_face_that_names_a_vertex_twice) {
  const auto read = read_faces(3, {{0, 1, 2}, {0, 1, 1}});
  EXPECT_EQ(num_faces(read.mesh), 2U);
}

TEST_F(Mesh_reading, accepts_a_face_that_names_one_vertex_three_times) {
  const auto read = read_faces(4, {{3, 3, 3}});
  EXPECT_EQ(num_vertices(read.mesh), 3U);
  EXPECT_EQ(read.file_vertices, 4U);
}

TEST_F(Mesh_reading, accepts_a_non_manifold_edge) { read_faces(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}); }

TEST_F(Mesh_reading, gives_a_non_manifold_vertex_once_per_fan) {
  const auto read = read_faces(5, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(num_vertices(read.mesh), 6U);
  EXPECT_EQ(std::ranges::count(read.file_vertex, 0U), 2);
}

TEST_F(Mesh_reading, accepts_faces_oriented_against_each_other) {
  const auto read = read_faces(4, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(num_vertices(read.mesh), 4U);
}

TEST_F(Mesh_reading, accepts_a_moebius_strip) {
  read_faces(5, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
}

TEST_F(Mesh_reading, accepts_the_same_face_many_times) {
  read_faces(3, {{0, 1, 2}, {0, 1, 2}});
  read_faces(3, {{0, 1, 2}, {2, 1, 0}});
  read_faces(4, {{0, 1, 2}, {0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {2, 1, 3}});
}

TEST_F(Mesh_reading, accepts_any_triangles_over_few_vertices) {
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    const std::size_t vertex_count = 1 + random() % 7;
    std::vector<std::array<int, 3>> triangles(1 + random() % 12);
    for (auto& corners : triangles)
      for (int& corner : corners) corner = static_cast<int>(random() % vertex_count);
    read_faces(vertex_count, triangles);
  }
}

TEST_F(Mesh_reading, drops_vertices_that_no_face_uses) {
  const auto read = read_faces(6, {{1, 3, 5}});
  EXPECT_EQ(read.file_vertices, 6U);
  EXPECT_EQ(read.file_vertex, (std::vector<std::uint32_t>{1, 3, 5}));
}

TEST_F(Mesh_reading, does_not_weld_equal_vertices) {
  const auto mesh = read("twins.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 5 4 6\n").mesh;
  EXPECT_EQ(num_vertices(mesh), 6U);
}

TEST_F(Mesh_reading, welds_equal_corners_of_stl_in_order_of_first_appearance) {
  const auto square = read("welded.stl", square_text_stl);
  EXPECT_EQ(square.file_vertices, 4U);
  EXPECT_EQ(square.file_vertex, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  const auto zero = read("zero.stl",
                         "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex -0 0 0\nvertex 1 0 0\n"
                         "endloop\nendfacet\nendsolid\n");
  EXPECT_EQ(zero.file_vertices, 2U) << "zero and minus zero are one place";
}

TEST_F(Mesh_reading, accepts_every_optional_part_of_off) {
  expect_square(read("one_line.off", "OFF 4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3"));
  expect_square(read("no_edges.off", "OFF\n4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3"));
  expect_square(read("comments.off",
                     "# a square\n\nOFF # keyword\n\n4 2 0 # counts\n0 0 0\n# half way\n1 0 0 # corner\n"
                     "1 1 0\n\n0 1 0\n3 0 1 2\n3 0 2 3\n# end\n\n"));
  expect_square(read("colours.off",
                     "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 7\n1 1 0\n0 1 0 1 1 1 1\n3 0 1 2 0.5 0.5 0\n"
                     "3 0 2 3 255 255 255\n"));
  expect_square(
      read("normals.off", "CNOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n3 0 2 3"));
}

TEST_F(Mesh_reading, accepts_every_optional_part_of_obj) {
  expect_square(
      read("all.obj",
           "# a square\nmtllib square.mtl\no square\ng a b\ns off\nv\t0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\n"
           "vt 0 0\nvn 0 0 1\nusemtl red\nf\t1/1/1\t2//1   3/1\t# a face\nv 0 1 0\nl 1 2\np 1\nf -4 -2 -1\n"));
  expect_square(read("forward.obj", "f 1 2 3\nf 1 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"));
}

TEST_F(Mesh_reading, skips_other_elements_and_properties_of_ply) {
  expect_square(
      read("more.ply",
           "ply\ncomment before the format\nformat ascii 1.0\nobj_info none\nelement material 1\n"
           "property list uint8 float shine\nelement vertex 4\nproperty uchar red\nproperty float32 x\n"
           "property list uchar int near\nproperty float64 y\nproperty double z\nproperty float quality\n"
           "element nothing 4000000000\nelement face 2\nproperty list int32 uint32 vertex_index\n"
           "property uchar flags\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
           "2 0.5 1\n9 0 1 7 0 0 nan\n9 1 0 0 0 1\n9 1 2 7 8 1 0 1\n9 0 0 1 0 1\n3 0 1 2 0\n3 0 2 3 0\n0 1\n"));
}

TEST_F(Mesh_reading, accepts_ply_with_integer_coordinates_and_short_indices) {
  const std::string header =
      "element vertex 4\nproperty char x\nproperty short y\nproperty uint z\n"
      "element face 2\nproperty list uchar ushort vertex_indices\nend_header\n";
  expect_square(read("text.ply", "ply\nformat ascii 1.0\n" + header + "0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3"));
  std::string body;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    body += packed<signed char>({double(x)}) + packed<short>({double(y)}) + packed<unsigned>({0});
  for (const int k : {1, 2}) body += '\3' + packed<unsigned short>({0, double(k), double(k + 1)});
  expect_square(read("binary.ply", "ply\nformat binary_little_endian 1.0\n" + header + body));
}

TEST_F(Mesh_reading, accepts_ply_that_lists_faces_first) {
  expect_square(read("first.ply",
                     "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 4\n"
                     "property float x\nproperty float y\nproperty float z\nend_header\n"
                     "3 0 1 2\n3 0 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"));
}

TEST_F(Mesh_reading, recognises_binary_stl_whose_header_begins_with_solid) {
  expect_square(read("solid.stl", square_binary_stl("solid facet normal vertex 1 2 3")));
}

TEST_F(Mesh_reading, accepts_stl_with_misleading_names_capitals_and_several_solids) {
  expect_square(
      read("names.stl",
           "solid solid facet endsolid\n"
           "facet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
           "endsolid facet\n\nSOLID two\nFACET NORMAL 0 0 1 OUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 1 0\n"
           "VERTEX 0 1 0\nENDLOOP ENDFACET\nENDSOLID\n"));
}

TEST_F(Mesh_reading, allows_exactly_as_many_faces_as_the_limit) {
  for (const auto& [name, bytes] : all_squares()) {
    SCOPED_TRACE(name);
    const auto file = folder.write(name, bytes);
    EXPECT_NO_THROW(read_mesh(file, {.max_faces = 2}));
    EXPECT_THROW(read_mesh(file, {.max_faces = 1}), Bad_mesh);
  }
}

}  // namespace
}  // namespace lodestone::test
