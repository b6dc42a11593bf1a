// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/face_neighbours.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "adjacent_pairs.h"
#include "lodestone/io/shapes.h"

namespace lodestone {
namespace {

struct Answer {
  std::vector<Face_pair> pairs;
  std::size_t exact_tests = 0;
};

Answer answer(const Positions& positions, std::span<const Corners> faces) {
  const auto vertex_count = static_cast<std::uint32_t>(positions.rows());
  const Vertex_fans fans(vertex_count, faces);
  Neighbour_check check;
  Answer result;
  check.check(fans, faces, {positions.data(), static_cast<std::size_t>(positions.size())}, 0, vertex_count,
              result.pairs);
  result.exact_tests = check.exact_tests();
  std::ranges::sort(result.pairs);
  return result;
}

Answer answer(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  return answer(numbered.positions, numbered.faces);
}

/// Checks a mesh against CGAL, whose faces without area are none; gives the number of pairs.
std::size_t expect_equal_to_cgal(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  const auto expected = reported_by_cgal(mesh, numbered.faces);
  EXPECT_EQ(expected.faces_without_area, 0U);
  EXPECT_EQ(answer(numbered.positions, numbered.faces).pairs, expected.pairs);
  return expected.pairs.size();
}

/// Moves every vertex at random, along the first `axes` axes.
void crumple(Surface_mesh& mesh, double distance, std::uint64_t seed, int axes = 3) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> step(0, distance);
  deform(mesh, [&](const Point& p) {
    const double x = step(random), y = step(random), z = step(random);
    return Point(p.x() + x, p.y() + (axes > 1 ? y : 0), p.z() + (axes > 2 ? z : 0));
  });
}

/// Turns a mesh by an angle that no coordinate survives without rounding.
void turn(Surface_mesh& mesh) {
  const Eigen::Matrix3d rotation(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  deform(mesh, [&](const Point& p) {
    const Eigen::Vector3d q = rotation * coordinates(p);
    return Point(q.x(), q.y(), q.z());
  });
}

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
    for (const double factor : {0x1p-1000, 0x1p-300, 0x1p-130, 0x1p130, 0x1p300, 0x1p1000}) {
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
    shift(mesh, 0, 0x1p20, 0);  // few digits are left: many vertices fall on a lattice
    const Numbered_mesh numbered(mesh);
    if (reported_by_cgal(mesh, numbered.faces).faces_without_area == 0) found += expect_equal_to_cgal(mesh);
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
    // Whole rows of vertices fall on a few lines, give or take a last digit.
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

TEST(Neighbour_check, takes_faces_without_area_as_segments_and_points) {
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

    // CGAL leaves out all pairs of a face without area.
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
    without_area += reported.faces_without_area;
  }
  EXPECT_GT(found, 20U);
  EXPECT_GT(without_area, 100U);
}

/// Faces around vertex 0, with the corners of the rim at `place(i)`, i = 0 .. count - 1.
template <class Place>
Surface_mesh fan(std::uint32_t count, bool closed, Place place) {
  std::vector<Point> points{{0, 0, 0}};
  std::vector<Corners> faces;
  for (std::uint32_t i = 0; i < count; ++i) points.push_back(place(i));
  for (std::uint32_t i = 0; i + (closed ? 0 : 1) < count; ++i) faces.push_back({0, i + 1, (i + 1) % count + 1});
  return mesh_of(points, faces);
}

Point on_circle(double angle, double height) { return {std::cos(angle), std::sin(angle), height}; }

TEST(Neighbour_check, takes_a_fan_of_2000_faces) {
  constexpr std::uint32_t count = 2000;
  const double step = 2 * std::numbers::pi / count;
  const auto cone = fan(count, true, [&](std::uint32_t i) { return on_circle(step * i, 0.5); });
  EXPECT_EQ(expect_equal_to_cgal(cone), 0U);
  EXPECT_EQ(answer(cone).exact_tests, 0U);

  // One neighbour steps across the next ones.
  const auto torn = fan(count, true, [&](std::uint32_t i) { return on_circle(step * (i == 7 ? 11.5 : i), 0); });
  EXPECT_GT(expect_equal_to_cgal(torn), 4U);
}

TEST(Neighbour_check, sees_fans_that_turn_more_than_once) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> height(-1, 1);
  std::size_t met = 0, apart = 0;
  for (const std::uint32_t count : {5, 6, 8, 15})
    for (const bool closed : {true, false})
      for (const double turns : {0.4, 0.6, 0.9, 1.0, 1.1, 1.3, 1.5, 1.7, 2.0})
        for (const double start : {0.0, 0.5, 1.0, 1.5, 3.0, 4.5}) {
          if (closed && turns != std::round(turns)) continue;
          const double step = 2 * std::numbers::pi * turns / (closed ? count : count - 1);
          // A spiral stair, or a flat one; and at any rate one that is seen as turning from above.
          const bool flat = random() % 2 == 0;
          auto mesh = fan(count, closed, [&](std::uint32_t i) {
            const double far = 0.5 + 0.5 * std::abs(height(random)), angle = start + step * i;
            return Point(far * std::cos(angle), far * std::sin(angle), flat ? 0 : 0.3 * height(random));
          });
          const auto pairs = expect_equal_to_cgal(mesh);
          turn(mesh);
          (pairs > 0 ? met : apart) += 1;
          expect_equal_to_cgal(mesh);
        }
  EXPECT_GT(met, 30U);
  EXPECT_GT(apart, 30U);
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

TEST(Neighbour_check, counts_exact_tests_until_told_to_start_anew) {
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
