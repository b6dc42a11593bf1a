// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lodestone/io/meshes/file_faces.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Outline = std::vector<Point>;

std::string polygon_off(const Outline& outline) {
  auto text = "OFF\n" + std::to_string(outline.size()) + " 1 0\n";
  for (const auto& p : outline)
    text += std::to_string(p.x()) + ' ' + std::to_string(p.y()) + ' ' + std::to_string(p.z()) + '\n';
  text += std::to_string(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) text += ' ' + std::to_string(i);
  return text + '\n';
}

Kernel::Vector_3 doubled_area(const Surface_mesh& mesh, Surface_mesh::Face_index face) {
  std::vector<Point> p;
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) p.push_back(mesh.point(v));
  return CGAL::cross_product(p.at(1) - p.at(0), p.at(2) - p.at(0));
}

class Polygons : public testing::Test {
 protected:
  Mesh_file read(const Outline& outline) const { return read_mesh(folder.write("a.off", polygon_off(outline))); }

  /// The triangles of a polygon of the plane z = 0 must all face upwards and have its area together.
  void expect_tiled(const Outline& outline, double area) const {
    const auto file = read(outline);
    ASSERT_EQ(file.mesh.number_of_faces(), outline.size() - 2);
    double sum = 0;
    for (const auto f : file.mesh.faces()) {
      const double part = doubled_area(file.mesh, f).z() / 2;
      EXPECT_GT(part, 0) << "triangle " << f;
      sum += part;
    }
    EXPECT_NEAR(sum, area, 1e-12 * area);
  }

  Temporary_folder folder;
};

const std::vector<Sample> quads{
    {"a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/2 3/3 4/4\n"},
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"}};

TEST_F(Polygons, a_quad_of_every_format_becomes_two_triangles_of_one_face) {
  for (const auto& [name, bytes] : quads) {
    SCOPED_TRACE(name);
    const auto file = read_mesh(folder.write(name, bytes));
    EXPECT_EQ(file.mesh.number_of_faces(), 2U);
    EXPECT_EQ(file.file_vertices, 4U);
    EXPECT_EQ(file.file_face, (std::vector<std::uint32_t>{0, 0}));
  }
}

TEST_F(Polygons, triangles_are_mapped_to_their_faces) {
  const auto file =
      read_mesh(folder.write("a.obj",
                             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 3 1 0\nv 2.5 2 0\nv 2 1 0\n"
                             "f 1 2 3\nf 5 6 7 8 9\nf 1 3 4\nf 1 2 3 4\n"));
  EXPECT_EQ(file.file_face, (std::vector<std::uint32_t>{0, 1, 1, 1, 2, 3, 3}));
  const auto faces = count_file_faces(file.file_face);
  EXPECT_EQ(faces.count, 4U);
  EXPECT_EQ(faces.cut, 2U);
}

TEST_F(Polygons, a_mesh_of_triangles_maps_each_to_itself) {
  for (const auto& [name, bytes] : all_squares())
    EXPECT_EQ(read_mesh(folder.write(name, bytes)).file_face, (std::vector<std::uint32_t>{0, 1})) << name;
}

TEST_F(Polygons, a_concave_quad_is_cut_inside_its_outline_wherever_the_notch_is) {
  const Outline arrow{{0, 0, 0}, {4, -2, 0}, {1, 0, 0}, {4, 2, 0}};  // the notch at (1, 0)
  for (std::size_t start = 0; start < 4; ++start) {
    Outline turned;
    for (std::size_t i = 0; i < 4; ++i) turned.push_back(arrow[(start + i) % 4]);
    expect_tiled(turned, 2);
  }
}

TEST_F(Polygons, a_parallelogram_is_cut_alike_however_its_corners_are_rounded) {
  for (int step = 0; step < 40; ++step) {
    const double angle = 0.1 * step, c = std::cos(angle), s = std::sin(angle);
    Outline turned;
    for (const auto& p : Outline{{0, 0, 0}, {1, 0.2, 0}, {1.3, 1.1, 0}, {0.3, 0.9, 0}})
      turned.emplace_back(100 + c * p.x() - s * p.y(), s * p.x() + c * p.y(), 0);
    const auto file = read(turned);
    for (const auto face : file.mesh.faces()) {
      const auto around = file.mesh.vertices_around_face(file.mesh.halfedge(face));
      EXPECT_EQ(std::ranges::count(around.begin(), around.end(), Surface_mesh::Vertex_index(0)), 1) << angle;
    }
  }
}

TEST_F(Polygons, concave_outlines_are_filled) {
  expect_tiled({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, 5);
  expect_tiled({{0, 0, 0},
                {5, 0, 0},
                {5, 3, 0},
                {4, 3, 0},
                {4, 1, 0},
                {3, 1, 0},
                {3, 3, 0},
                {2, 3, 0},
                {2, 1, 0},
                {1, 1, 0},
                {1, 3, 0},
                {0, 3, 0}},
               11);
}

/// As a program writes a face with holes: the outline runs to each hole and back along the same side.
TEST_F(Polygons, an_outline_that_runs_to_holes_and_back_leaves_them_open) {
  const std::string points =
      "OFF\n12 1 0\n0 0 0\n9 0 0\n9 4 0\n0 4 0\n1 1 0\n3 1 0\n3 3 0\n1 3 0\n5 1 0\n7 1 0\n7 3 0\n5 3 0\n";
  const auto read_face = [&](const std::string& corners) {
    return read_mesh(folder.write("holes.off", points + corners + '\n'));
  };
  const auto expect_area = [&](const Mesh_file& file, std::size_t faces, double area) {
    EXPECT_EQ(file.mesh.number_of_faces(), faces);
    double sum = 0;
    for (const auto f : file.mesh.faces()) {
      EXPECT_GT(doubled_area(file.mesh, f).z(), 0) << f;
      sum += doubled_area(file.mesh, f).z() / 2;
    }
    EXPECT_DOUBLE_EQ(sum, area);
  };
  expect_area(read_face("10 0 1 2 3 0 4 7 6 5 4"), 8, 32);
  expect_area(read_face("16 0 1 2 3 0 4 7 6 8 11 10 9 8 6 5 4"), 14, 28);
  expect_area(read_face("16 4 0 1 2 3 0 4 7 6 8 11 10 9 8 6 5"), 14, 28);
}

/// Two triangles with one corner in common: their triangulation would have fewer triangles than a fan.
TEST_F(Polygons, an_outline_of_parts_that_touch_in_a_corner_is_a_fan) {
  const auto file = read_mesh(folder.write("a.off", "OFF\n5 1 0\n0 0 0\n2 0 0\n1 1 0\n2 2 0\n0 2 0\n6 0 1 2 3 4 2\n"));
  EXPECT_EQ(file.mesh.number_of_faces(), 4U);
  for (const auto f : file.mesh.faces()) {
    bool has_first = false;
    for (const auto v : file.mesh.vertices_around_face(file.mesh.halfedge(f))) has_first |= file.file_vertex[v] == 0;
    EXPECT_TRUE(has_first) << f;
  }
}

TEST_F(Polygons, a_hole_may_touch_the_outline_in_a_corner) {
  const auto file =
      read_mesh(folder.write("a.off", "OFF\n6 1 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n1 2 0\n2 1 0\n7 0 1 2 3 0 4 5\n"));
  double sum = 0;
  for (const auto f : file.mesh.faces()) {
    EXPECT_GT(doubled_area(file.mesh, f).z(), 0) << f;
    sum += doubled_area(file.mesh, f).z() / 2;
  }
  EXPECT_DOUBLE_EQ(sum, 14.5);
}

TEST_F(Polygons, corners_on_straight_sides_are_legal) {
  expect_tiled({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}}, 4);
}

TEST_F(Polygons, a_face_may_have_more_corners_than_a_byte_counts) {
  Outline circle;
  constexpr int sides = 1000;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::acos(-1) * i / sides;
    circle.emplace_back(std::round(1e6 * std::cos(angle)), std::round(1e6 * std::sin(angle)), 0);
  }
  double doubled = 0;
  for (int i = 0; i < sides; ++i) {
    const auto &p = circle[i], &q = circle[(i + 1) % sides];
    doubled += p.x() * q.y() - q.x() * p.y();
  }
  expect_tiled(circle, doubled / 2);
}

TEST_F(Polygons, a_face_that_is_not_planar_keeps_its_sides_and_its_orientation) {
  const Outline saddle{{0, 0, 0}, {2, 0, 1}, {3, 2, 0}, {2, 4, 1}, {0, 4, 0}, {-1, 2, 1}};
  const auto file = read(saddle);
  EXPECT_EQ(file.mesh.number_of_faces(), 4U);
  std::size_t sides = 0;
  for (const auto e : file.mesh.edges()) sides += file.mesh.is_border(e) ? 1 : 0;
  EXPECT_EQ(sides, saddle.size());
  for (const auto f : file.mesh.faces()) EXPECT_GT(doubled_area(file.mesh, f).z(), 0);
}

TEST_F(Polygons, the_plane_does_not_matter) {
  const Outline notched{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  for (int axis = 0; axis < 3; ++axis)
    for (const bool reversed : {false, true}) {
      Outline turned;
      for (const auto& p : notched) {
        const double c[] = {p.x(), p.y(), p.z()};
        turned.emplace_back(c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3]);
      }
      if (reversed) turned = {turned.rbegin(), turned.rend()};
      const auto file = read(turned);
      Kernel::Vector_3 sum(0, 0, 0);
      double lengths = 0;
      for (const auto f : file.mesh.faces()) {
        sum = sum + doubled_area(file.mesh, f);
        lengths += std::sqrt(doubled_area(file.mesh, f).squared_length());
      }
      EXPECT_DOUBLE_EQ(std::sqrt(sum.squared_length()), 10);
      EXPECT_DOUBLE_EQ(lengths, 10) << "all triangles face the same way";
    }
}

TEST_F(Polygons, degenerate_faces_become_fans) {
  const std::vector<Outline> degenerate{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},   // no area
                                        {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},   // a point
                                        {{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}, {-1, 2, 0}},  // crosses itself
                                        {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}};  // touches itself
  for (const auto& outline : degenerate) {
    const auto file = read(outline);
    EXPECT_EQ(file.mesh.number_of_faces(), 3U);
    for (const auto f : file.mesh.faces()) {
      bool has_first = false;
      for (const auto v : file.mesh.vertices_around_face(file.mesh.halfedge(f))) has_first |= file.file_vertex[v] == 0;
      EXPECT_TRUE(has_first);
    }
  }
}

TEST_F(Polygons, a_face_may_name_a_vertex_twice) {
  const auto file = read_mesh(folder.write("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 1 2\n5 0 1 2 1 0\n"));
  EXPECT_EQ(file.file_face, (std::vector<std::uint32_t>{0, 0, 1, 1, 1}));
}

TEST_F(Polygons, the_limit_holds_for_the_triangles) {
  const auto quad = folder.write("a.off", quads[0].bytes);
  EXPECT_NO_THROW(read_mesh(quad, {.max_faces = 2}));
  EXPECT_THROW(read_mesh(quad, {.max_faces = 1}), Bad_mesh);
}

TEST_F(Polygons, the_triangles_of_a_sequence_are_those_of_its_first_frame) {
  // The better diagonal of the quad changes from one frame to the other.
  folder.write("q0.off", "OFF\n4 1 0\n0 0 0\n4 -2 0\n1 0 0\n4 2 0\n4 0 1 2 3\n");
  folder.write("q1.off", "OFF\n4 1 0\n1 0 0\n4 -2 0\n9 0 0\n4 2 0\n4 0 1 2 3\n");
  const auto animation = read_animation(folder.path() / "q*.off");
  EXPECT_EQ(animation.faces, (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}));
  std::vector<Point> positions(4);
  animation.motion.pose(1, positions);
  EXPECT_EQ(positions[2], Point(9, 0, 0));
}

TEST_F(Polygons, lines_of_obj_go_on_after_a_backslash) {
  const auto file = read_mesh(folder.write(
      "a.obj", "v 0 0 \\\n0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng one \\\n two\nf 1 2 \\\r\n 3 \\\n\\\n4\nf 1 2 3\\"));
  EXPECT_EQ(file.file_face, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(file.file_vertices, 4U);
}

/// Each line break replaced.
std::string with_line_end(std::string text, const std::string& end) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size()) text.replace(at, 1, end);
  return text;
}

TEST_F(Polygons, lines_may_end_in_any_way) {
  const std::string ply_header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string ply_body =
      packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + packed<std::uint8_t>({3}) + packed<std::int32_t>({0, 1, 2});
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid a\n";
  for (const std::string end : {"\n", "\r\n", "\r", "\r\r\n"}) {
    SCOPED_TRACE(testing::PrintToString(end));
    const auto faces = [&](const char* name, const std::string& bytes) {
      return read_mesh(folder.write(name, bytes)).mesh.number_of_faces();
    };
    EXPECT_EQ(faces("a.off", with_line_end("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", end)), 1U);
    EXPECT_EQ(faces("a.obj", with_line_end("# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", end)), 1U);
    EXPECT_EQ(faces("a.stl", with_line_end(stl, end)), 1U);
    if (end == "\r\r\n") continue;
    EXPECT_EQ(faces("b.obj", with_line_end("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 3\n", end)), 1U);
    EXPECT_EQ(faces("a.ply", with_line_end(ply_header, end) + ply_body), 1U);
  }
}

TEST_F(Polygons, what_vertices_of_off_hold_may_be_named_in_any_order) {
  for (const auto* keyword : {"STCNOFF", "CNOFF", "NCOFF", "CSTOFF", "NSTOFF"})
    EXPECT_EQ(read_mesh(folder.write("a.off", keyword + std::string("\n3 1 0\n0 0 0 9 9 9 9\n1 0 0 9 9 9 9\n0 1 0 9 9 "
                                                                    "9 9\n3 0 1 2\n")))
                  .mesh.number_of_faces(),
              1U)
        << keyword;
}

TEST_F(Polygons, the_keyword_of_off_may_be_glued_to_the_number_of_vertices) {
  auto bytes = square_off;
  const auto file = read_mesh(folder.write("a.off", bytes.replace(0, 4, "OFF")));
  EXPECT_EQ(file.file_vertices, 4U);
  EXPECT_EQ(file.mesh.number_of_faces(), 2U);
}

}  // namespace
}  // namespace lodestone::test
