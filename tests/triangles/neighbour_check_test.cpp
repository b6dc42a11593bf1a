// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/neighbour_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lodestone/io/shapes/shapes.h"
#include "triangles/adjacent_pairs.h"

namespace lodestone {
namespace {

std::vector<Surface_mesh> surfaces() {
  return {icosphere(5), uv_sphere(16, 12), torus_knot({.tube = 0.15, .segments = 60, .sides = 8}), cloth(14, 12),
          cube(5)};
}

TEST(Neighbour_check, equals_cgal_on_crumpled_surfaces) {
  std::size_t found = 0;
  std::uint64_t seed = 0;
  for (const auto& surface : surfaces())
    for (const double distance : {0.0, 0.01, 0.03, 0.06, 0.1, 0.3, 1.0}) {
      auto mesh = surface;
      crumple(mesh, distance, ++seed);
      found += expect_equal_to_cgal(mesh);
    }
  EXPECT_GT(found, 3000U);
}

TEST(Neighbour_check, equals_cgal_on_tiny_huge_and_far_away_surfaces) {
  std::size_t found = 0;
  std::uint64_t seed = 0;
  for (const auto& surface : surfaces())
    for (const double factor : {0x1p-1000, 0x1p-300, 0x1p-130, 0x1p130, 0x1p300, 0x1p341, 0x1p511, 0x1p1000}) {
      auto mesh = surface;
      crumple(mesh, 0.1, ++seed);
      scale(mesh, factor);
      found += expect_equal_to_cgal(mesh);
    }
  for (const auto& surface : surfaces()) {
    auto mesh = surface;
    crumple(mesh, 0.1, ++seed);
    shift(mesh, 0x1p20, -0x1p20, 0x1p20);
    found += expect_equal_to_cgal(mesh);
    scale(mesh, 0x1p-20);
    shift(mesh, 0, 0x1p20, 0);  // few digits are left: many vertices round to a lattice
    const Numbered_mesh numbered(mesh);
    if (reported_by_cgal(mesh, numbered.faces).zero_area_faces == 0) found += expect_equal_to_cgal(mesh);
  }
  EXPECT_GT(found, 3000U);
}

TEST(Neighbour_check, equals_cgal_on_flat_cloth_with_folds) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    auto mesh = cloth(14, 12);
    crumple(mesh, 0.01 * static_cast<double>(seed), seed, 2);
    found += expect_equal_to_cgal(mesh);
    turn(mesh);  // nearly flat: rounding decides
    found += expect_equal_to_cgal(mesh);
  }
  EXPECT_GT(found, 3000U);
}

TEST(Neighbour_check, equals_cgal_on_cloth_folded_onto_itself_along_edges) {
  std::size_t found = 0;
  for (const auto fold : {+[](double x, double y) { return Point(std::abs(x - 0.5), y, 0); },
                          +[](double x, double y) { return Point(std::abs(x - 0.5), std::abs(y - 0.25), 0); },
                          +[](double x, double y) { return Point(std::min(x, y), std::max(x, y), 0); },
                          +[](double x, double y) { return Point(std::abs(x - 0.5), y, x < 0.5 ? 0x1p-60 * y : 0); }}) {
    auto mesh = cloth(8, 8);
    deform(mesh, [&](const Point& p) { return fold(p.x(), p.y()); });
    found += expect_equal_to_cgal(mesh);
    turn(mesh);
    found += expect_equal_to_cgal(mesh);
  }
  EXPECT_GT(found, 100U);
}

TEST(Neighbour_check, equals_cgal_where_one_last_digit_decides) {
  std::mt19937_64 random(1);
  std::size_t found = 0;
  for (int trial = 0; trial < 30; ++trial) {
    auto mesh = cloth(8, 8);
    // Whole rows of vertices are on a few lines, up to a last digit.
    deform(mesh, [&](const Point& p) {
      const auto digit = [&] { return 0x1p-52 * (static_cast<double>(random() % 3) - 1); };
      const double z = trial % 2 == 0 ? 0 : 0.3 * p.x() + 0.7 * p.y();
      return Point(1 + std::abs(p.x() - 0.5) + digit(), 1 + p.y() + digit(), 1 + z + digit());
    });
    found += expect_equal_to_cgal(mesh);
  }
  EXPECT_GT(found, 100U);
  EXPECT_LT(found, 30U * 200U);
}

TEST(Neighbour_check, equals_cgal_where_products_of_coordinates_are_a_few_units_of_the_smallest_double) {
  std::size_t found = 0;
  for (int trial = 0; trial < 120; ++trial) {
    auto mesh = icosphere(2);
    crumple(mesh, 0.3, static_cast<std::uint64_t>(trial));
    scale(mesh, std::ldexp(1, -365 + trial % 15));  // products of three
    found += expect_equal_to_cgal(mesh);
    scale(mesh, std::ldexp(1, -180));  // products of two
    found += expect_equal_to_cgal(mesh);
  }
  EXPECT_GT(found, 1000U);
}

TEST(Neighbour_check, of_smooth_surfaces_needs_no_exact_test) {
  for (const auto& surface : surfaces()) {
    auto mesh = surface;
    deform(mesh, [](const Point& p) {
      return Point(p.x() + 0.1 * std::sin(3 * p.y()), p.y() + 0.1 * std::sin(3 * p.z()),
                   p.z() + 0.1 * std::sin(3 * p.x()));
    });
    for (const double factor : {1.0, 0x1p-300, 0x1p300}) {
      scale(mesh, factor);
      const auto result = answer(mesh);
      EXPECT_TRUE(result.pairs.empty());
      EXPECT_EQ(result.exact_tests, 0U);
      scale(mesh, 1 / factor);
    }
  }
}

TEST(Neighbour_check, of_flat_sides_that_meet_at_right_angles_needs_no_exact_test) {
  auto mesh = cube(5);
  EXPECT_EQ(answer(mesh).exact_tests, 0U);
  turn(mesh);
  EXPECT_EQ(answer(mesh).exact_tests, 0U);
}

/// Faces around vertex 0, side by side in the plane z = 0, and one more at the same vertex that stands on it.
std::pair<Positions, std::vector<Corners>> flat_fan_with_a_wall(std::uint32_t faces) {
  Positions positions(faces + 4, 3);
  positions.setZero();
  std::vector<Corners> corners;
  for (std::uint32_t i = 0; i <= faces; ++i) {
    const double angle = 6 * static_cast<double>(i) / faces;  // less than a whole turn
    positions.row(1 + i) << std::cos(angle), std::sin(angle), 0;
    if (i > 0) corners.push_back(i % 3 == 0 ? Corners{0, i + 1, i} : Corners{i, i + 1, 0});
  }
  positions.row(faces + 2) << 1, -0.1, 0.5;
  positions.row(faces + 3) << 1, -0.1, 1;
  corners.push_back({0, faces + 2, faces + 3});
  return {positions, corners};
}

TEST(Neighbour_check, of_a_flat_fan_with_a_face_beside_it_needs_no_exact_test) {
  auto [positions, faces] = flat_fan_with_a_wall(40);
  const auto needs_none = [&faces = faces](const Positions& at) {
    const auto result = answer(at, faces);
    EXPECT_EQ(result.pairs, by_definition::adjacent_pairs(at, faces));
    EXPECT_EQ(result.exact_tests, 0U);
  };
  needs_none(positions);
  for (const double factor : {0x1p-140, 0x1p-300, 0x1p300}) needs_none(factor * positions);
  Positions turned = positions;
  for (int axis = 1; axis < 3; ++axis) {
    for (int column = 0; column < 3; ++column) turned.col((column + axis) % 3) = positions.col(column);
    needs_none(turned);
  }
}

TEST(Neighbour_check, equals_the_definition_on_flat_fans_that_overlap) {
  std::mt19937_64 random(4);
  std::size_t found = 0, without = 0;
  for (int trial = 0; trial < 200; ++trial) {
    // Faces around vertex 0 in a plane, most of them narrow; those on a lattice have edges on each other.
    std::uniform_real_distribution<double> place(-1, 1);
    const auto coordinate = [&] { return trial % 2 == 0 ? place(random) : static_cast<double>(random() % 5) - 2; };
    Positions positions(17, 3);
    positions.row(0).setZero();
    for (int v = 1; v < 17; v += 2) {
      const double x = coordinate(), y = coordinate();
      positions.row(v) << x, y, x + 2 * y;
      const double x2 = x + 0.2 * coordinate(), y2 = y + 0.2 * coordinate();
      positions.row(v + 1) << x2, y2, x2 + 2 * y2;
    }
    if (trial % 3 == 0) positions.col(2).setZero();
    std::vector<Corners> faces{{1, 3, 5}};
    for (std::uint32_t v = 1; v < 17; v += 2) faces.push_back({v, v + 1, 0});
    const auto expected = by_definition::adjacent_pairs(positions, faces);
    const auto result = answer(positions, faces);
    ASSERT_EQ(result.pairs, expected) << trial;
    found += expected.size();
    without += result.exact_tests == expected.size() ? 1 : 0;
  }
  EXPECT_GT(found, 200U);
  EXPECT_GT(without, 60U) << "pairs that surely meet in the vertex only are told apart";
}

TEST(Neighbour_check, equals_the_definition_on_any_faces) {
  std::mt19937_64 random(2);
  std::size_t found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    // Few vertices for many faces: edges with several faces, equal faces, all orientations. Half of them on a lattice.
    std::uniform_real_distribution<double> place(-1, 1);
    Positions positions(14, 3);
    for (double& x : positions.reshaped()) x = trial % 2 == 0 ? place(random) : static_cast<double>(random() % 3);
    if (trial % 5 == 0) positions.col(2).setZero();
    std::vector<Corners> faces(25);
    for (auto& corners : faces)
      for (auto& corner : corners) corner = static_cast<std::uint32_t>(random() % 14);
    faces.push_back(faces.front());
    faces.push_back({faces[1][2], faces[1][1], faces[1][0]});
    const auto expected = by_definition::adjacent_pairs(positions, faces);
    found += expected.size();
    ASSERT_EQ(answer(positions, faces).pairs, expected) << trial;
    positions *= trial % 3 == 0 ? 0x1p-300 : 0x1p300;
    ASSERT_EQ(answer(positions, faces).pairs, expected) << trial;
  }
  EXPECT_GT(found, 1000U);
}

TEST(Neighbour_check, treats_zero_area_faces_as_segments_and_points) {
  std::mt19937_64 random(3);
  std::size_t found = 0, without_area = 0;
  for (int trial = 0; trial < 12; ++trial) {
    auto mesh = trial % 2 == 0 ? cloth(6, 6) : icosphere(2);
    deform(mesh,
           [](const Point& p) { return Point(std::round(6 * p.x()), std::round(6 * p.y()), std::round(6 * p.z())); });
    for (const auto h : mesh.halfedges())
      if (random() % 12 == 0) mesh.point(mesh.target(h)) = mesh.point(mesh.source(h));
    const Numbered_mesh numbered(mesh);
    const auto pairs = answer(numbered.positions, numbered.faces).pairs;
    ASSERT_EQ(pairs, by_definition::adjacent_pairs(numbered.positions, numbered.faces)) << trial;

    // CGAL omits all pairs of a zero-area face.
    const auto reported = reported_by_cgal(mesh, numbered.faces);
    const auto has_area = [&](std::uint32_t face) {
      const auto& [a, b, c] = numbered.faces[face];
      const auto point = [&](std::uint32_t v) { return mesh.point(Surface_mesh::Vertex_index(v)); };
      return !CGAL::collinear(point(a), point(b), point(c));
    };
    auto with_area = pairs;
    std::erase_if(with_area, [&](const Face_pair& pair) { return !has_area(pair.a) || !has_area(pair.b); });
    EXPECT_EQ(with_area, reported.pairs) << trial;
    found += pairs.size() - with_area.size();
    without_area += reported.zero_area_faces;
  }
  EXPECT_GT(found, 20U);
  EXPECT_GT(without_area, 100U);
}

TEST(Neighbour_check, finds_each_pair_once_however_vertices_are_split) {
  std::mt19937_64 random(5);
  auto mesh = torus_knot({.tube = 0.15, .segments = 60, .sides = 8});
  crumple(mesh, 0.1, 1);
  const Numbered_mesh numbered(mesh);
  const auto vertex_count = numbered.numbering.vertex_count();
  const Vertex_fans fans(vertex_count, numbered.faces);
  const std::span positions(numbered.positions.data(), static_cast<std::size_t>(numbered.positions.size()));
  const auto expected = answer(mesh).pairs;
  EXPECT_GT(expected.size(), 100U);
  for (int trial = 0; trial < 20; ++trial) {
    Neighbour_check check;
    const Face_pair earlier{1000000, 1000000};
    std::vector<Face_pair> found{earlier};
    std::vector<std::uint32_t> cuts{0, vertex_count};
    for (int i = 0; i < trial; ++i) cuts.push_back(static_cast<std::uint32_t>(random() % (vertex_count + 1)));
    std::ranges::sort(cuts);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      check.check(fans, numbered.faces, positions, cuts[i], cuts[i + 1], found);
    EXPECT_EQ(found.front(), earlier);
    found.erase(found.begin());
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
  }
}

TEST(Neighbour_check, counts_exact_tests_until_reset) {
  auto mesh = cloth(8, 8);
  crumple(mesh, 0.1, 1);
  const Numbered_mesh numbered(mesh);
  const Vertex_fans fans(numbered.numbering.vertex_count(), numbered.faces);
  const std::span positions(numbered.positions.data(), static_cast<std::size_t>(numbered.positions.size()));
  Neighbour_check check;
  std::vector<Face_pair> found;
  check.check(fans, numbered.faces, positions, 0, fans.vertex_count(), found);
  EXPECT_GT(found.size(), 0U);
  EXPECT_GE(check.exact_tests(), found.size());
  check.reset_count();
  EXPECT_EQ(check.exact_tests(), 0U);
}

}  // namespace
}  // namespace lodestone
