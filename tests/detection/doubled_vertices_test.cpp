// SPDX-License-Identifier: GPL-3.0-or-later
// Files whose faces share vertices that a half-edge mesh cannot share: their faces are neighbours all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/triangles/neighbour_check.h"
#include "support/exact_truth.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

Mesh_file read_off(const std::string& text) {
  const test::Temporary_folder folder;
  return read_mesh(folder.write("mesh.off", text));
}

/// Every pair of faces, with their corners as the file numbers them.
std::vector<Face_pair> pairs_by_file_vertices(const Mesh_file& file) {
  std::vector<Corners> corners(file.mesh.number_of_faces());
  for (const auto f : file.mesh.faces())
    std::ranges::transform(file.mesh.vertices_around_face(file.mesh.halfedge(f)), corners[f].begin(),
                           [&](auto v) { return file.file_vertex[v]; });
  std::vector<Face_pair> pairs;
  for (std::uint32_t f = 0; f < corners.size(); ++f)
    for (std::uint32_t g = f + 1; g < corners.size(); ++g)
      if (faces_intersect(corners[f], triangle_of(file.mesh, f), corners[g], triangle_of(file.mesh, g)))
        pairs.push_back({f, g});
  return pairs;
}

/// An axis-aligned box of twelve faces over these eight vertices: bit 0 of the place is x, bit 1 y, bit 2 z.
std::string box_faces(const std::array<int, 8>& v) {
  std::string text;
  for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                   std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
    for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{a, c, d}})
      text += "3 " + std::to_string(v[p]) + " " + std::to_string(v[q]) + " " + std::to_string(v[r]) + "\n";
  return text;
}

const std::string bow = "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 3 4\n";
const std::string fan = "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n-1 1 0\n-1 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
const std::string two_boxes_at_an_edge =
    "OFF\n14 24 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
    "2 1 0\n1 2 0\n2 2 0\n2 1 1\n1 2 1\n2 2 1\n" +
    box_faces({0, 1, 2, 3, 4, 5, 6, 7}) + box_faces({3, 8, 9, 10, 7, 11, 12, 13});

TEST(Doubled_vertices, make_no_neighbours_collide) {
  for (const auto& text : {bow, fan, two_boxes_at_an_edge}) {
    auto file = read_off(text);
    ASSERT_GT(file.mesh.number_of_vertices(), file.file_vertices);
    ASSERT_EQ(pairs_by_file_vertices(file), std::vector<Face_pair>{});
    Exact_detector as_in_file(self_collision), as_in_mesh(self_collision);
    as_in_file.add(file.mesh, {.file_vertex = file.file_vertex});
    as_in_mesh.add(std::as_const(file.mesh));
    for (int frame = 0; frame < 3; ++frame) {
      EXPECT_FALSE(as_in_file.detect().collides());
      EXPECT_TRUE(as_in_mesh.detect().collides());
      deform(file.mesh, [](const Point& p) { return Point(p.x() + 0.1 * p.y() * p.z(), p.y(), 1.5 * p.z()); });
    }
  }
}

TEST(Doubled_vertices, hide_no_collision) {
  auto file = read_off(two_boxes_at_an_edge);
  Exact_detector detector(self_collision);
  detector.add(std::as_const(file.mesh), {.file_vertex = file.file_vertex});
  // The edge of the second box that lies across from the common one is pushed through the first box.
  std::size_t found = 0;
  for (const double depth : {0.5, 1.2, 2.2, 0.0, 3.0}) {
    auto moved = file;
    for (const auto v : moved.mesh.vertices()) {
      const Point p = file.mesh.point(v);
      if (p.x() == 2 && p.y() == 2) moved.mesh.point(v) = Point(2 - depth, 2 - depth, p.z() - 0.25 * depth);
    }
    detector.update(0, positions_of(moved.mesh));
    const auto truth = pairs_by_file_vertices(moved);
    expect_contacts(detector.detect(), 0, 0, truth);
    found += truth.size();
  }
  EXPECT_GT(found, 20U);
}

TEST(Doubled_vertices, count_once_for_what_is_closed) {
  // Two boxes on a common wall that is there twice: each of its edges has four faces, or three and one.
  const auto file =
      read_off("OFF\n12 24 0\n0 0 0\n2 0 0\n0 2 0\n2 2 0\n0 0 2\n2 0 2\n0 2 2\n2 2 2\n4 0 0\n4 2 0\n4 0 2\n4 2 2\n" +
               box_faces({0, 1, 2, 3, 4, 5, 6, 7}) + box_faces({1, 8, 3, 9, 5, 10, 7, 11}));
  auto inside = tetrahedron();
  scale(inside, 0.1);
  shift(inside, 1.4, 1.4, 0.4);
  for (const bool joined : {true, false}) {
    Exact_detector detector({.mode = Mode::exact});
    detector.add(file.mesh, {.file_vertex = joined ? file.file_vertex : std::vector<std::uint32_t>()});
    detector.add(std::as_const(inside));
    EXPECT_EQ(detector.contains(0, 1), joined);
  }
}

TEST(Doubled_vertices, are_told_anew_by_a_rebuild) {
  auto file = read_off(bow);
  const auto other = read_off(fan);
  Exact_detector detector(self_collision);
  detector.add(file.mesh, {.file_vertex = file.file_vertex});
  EXPECT_FALSE(detector.detect().collides());
  file.mesh.clear();
  append(file.mesh, other.mesh);
  EXPECT_THROW(detector.rebuild(0, file.file_vertex), Bad_argument);
  EXPECT_THROW(detector.detect(), Bad_mesh);  // still the object of two faces
  detector.rebuild(0, other.file_vertex);
  EXPECT_FALSE(detector.detect().collides());
  detector.rebuild(0);
  EXPECT_TRUE(detector.detect().collides());
}

TEST(Doubled_vertices, of_another_number_than_the_mesh_has_are_refused_and_nothing_is_added) {
  auto file = read_off(bow);
  Exact_detector detector(self_collision);
  EXPECT_THROW(detector.add(file.mesh, {.file_vertex = {0, 1, 2}}), Bad_argument);
  EXPECT_EQ(detector.size(), 0U);
  EXPECT_EQ(detector.add(file.mesh, {.file_vertex = file.file_vertex}), 0U);
}

}  // namespace
}  // namespace lodestone
