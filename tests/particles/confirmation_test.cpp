// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/confirmation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lodestone/triangles/triangle_intersection.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// Some faces of a mesh as a patch at their positions. Not movable, since it refers to itself.
struct Placed_patch {
  Patch patch;
  Posed_patch posed;
  Positions positions;
  std::vector<Corners> corners;

  Placed_patch(const Positions& where, std::span<const Corners> mesh_faces, std::vector<std::uint32_t> faces)
      : patch(make_patch(std::move(faces), mesh_faces)),
        positions(where),
        corners(mesh_faces.begin(), mesh_faces.end()) {
    posed.patch = &patch;
    pose_patch(
        posed, [&](std::uint32_t v) { return Eigen::Vector3d(positions.row(v)); }, 1);
  }
  Placed_patch(const Placed_patch&) = delete;
  Placed_patch& operator=(const Placed_patch&) = delete;

  Triangle triangle(std::uint32_t face) const {
    const auto point = [&](std::uint32_t v) { return Point(positions(v, 0), positions(v, 1), positions(v, 2)); };
    return {point(corners[face][0]), point(corners[face][1]), point(corners[face][2])};
  }
};

std::vector<Face_pair> double_loop(const Placed_patch& a, const Placed_patch& b) {
  std::vector<Face_pair> pairs;
  for (const auto i : a.patch.faces)
    for (const auto j : b.patch.faces)
      if (triangles_intersect(a.triangle(i), b.triangle(j))) pairs.push_back({i, j});
  return pairs;
}

/// Checks all three queries on one pair of patches; returns the number of intersecting face pairs.
std::size_t expect_equal_to_double_loop(Confirmation& confirmation, const Placed_patch& a, const Placed_patch& b) {
  const auto expected = double_loop(a, b);
  const Face_pair earlier{1000000, 1000000};

  std::vector<Face_pair> all{earlier};
  EXPECT_EQ(confirmation.confirm(a.posed, b.posed, Contact_query::all, all), !expected.empty());
  EXPECT_EQ(all.front(), earlier);
  all.erase(all.begin());
  std::ranges::sort(all);
  EXPECT_EQ(all, expected);

  std::vector<Face_pair> first;
  EXPECT_EQ(confirmation.confirm(a.posed, b.posed, Contact_query::first, first), !expected.empty());
  EXPECT_EQ(first.size(), expected.empty() ? 0U : 1U);
  if (!first.empty()) {
    EXPECT_TRUE(std::ranges::binary_search(expected, first.front()));
  }

  std::vector<Face_pair> ignored;
  EXPECT_EQ(confirmation.confirm(a.posed, b.posed, Contact_query::yes_no, ignored), !expected.empty());
  return expected.size();
}

std::vector<std::uint32_t> some_of(std::size_t count, std::mt19937_64& random) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t face = 0; face < count; ++face)
    if (random() % 3 != 0) faces.push_back(face);
  return faces;
}

TEST(Confirmation, equals_a_double_loop_on_patches_of_two_surfaces) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-2, 2);
  const Numbered_mesh mesh(potato(5));
  Confirmation confirmation;
  std::size_t found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Placed_patch a(mesh.positions, mesh.faces, some_of(mesh.faces.size(), random));
    Positions moved = mesh.positions;
    moved.rowwise() += Eigen::RowVector3d(offset(random), offset(random), offset(random));
    const Placed_patch b(moved, mesh.faces, some_of(mesh.faces.size(), random));
    found += expect_equal_to_double_loop(confirmation, a, b);
  }
  EXPECT_GT(found, 200U);
}

TEST(Confirmation, equals_a_double_loop_on_triangles_on_a_lattice_that_touch_and_collapse) {
  std::mt19937_64 random(2);
  Confirmation confirmation;
  std::size_t found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto soup = [&](double offset) {
      Positions positions(12, 3);
      for (Eigen::Index v = 0; v < 12; ++v)
        for (int axis = 0; axis < 3; ++axis) positions(v, axis) = static_cast<double>(random() % 5);
      positions.col(0).array() += offset;
      return positions;
    };
    std::vector<Corners> faces;
    for (std::uint32_t i = 0; i < 12; ++i) faces.push_back({i, (i + 1) % 12, (i + 5) % 12});
    const Placed_patch a(soup(0), faces, some_of(12, random));
    const Placed_patch b(soup(static_cast<double>(trial % 6)), faces, some_of(12, random));
    found += expect_equal_to_double_loop(confirmation, a, b);
  }
  EXPECT_GT(found, 1000U);
}

TEST(Confirmation, finds_patches_that_touch_in_one_point) {
  const std::vector<Corners> faces{{0, 1, 2}};
  const Positions left = (Positions(3, 3) << 0, 0, 0, -1, 0, 0, 0, -1, 0).finished();
  const Positions right = (Positions(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 1).finished();
  Confirmation confirmation;
  EXPECT_EQ(expect_equal_to_double_loop(confirmation, {left, faces, {0}}, {right, faces, {0}}), 1U);
}

TEST(Confirmation, of_patches_far_apart_needs_no_exact_test) {
  const Numbered_mesh mesh(potato(5));
  Positions moved = mesh.positions;
  moved.col(1).array() += 100;
  std::vector<std::uint32_t> all(mesh.faces.size());
  for (std::uint32_t face = 0; face < all.size(); ++face) all[face] = face;
  const Placed_patch a(mesh.positions, mesh.faces, all), b(moved, mesh.faces, all);
  Confirmation confirmation;
  EXPECT_EQ(expect_equal_to_double_loop(confirmation, a, b), 0U);
  EXPECT_EQ(confirmation.exact_tests(), 0U);
}

TEST(Confirmation, finds_and_counts_the_same_with_several_workers) {
  const Numbered_mesh mesh(potato(14));
  std::vector<std::uint32_t> all(mesh.faces.size());
  for (std::uint32_t face = 0; face < all.size(); ++face) all[face] = face;
  Workers five(5);
  Confirmation alone, shared;  // each keeps its memory from one call to the next
  std::size_t found_any = 0, found_none = 0;
  for (const double offset : {0.02, 1.9, 5.0, 0.4, 1.2}) {
    Positions moved = mesh.positions;
    moved.col(0).array() += offset;
    const Placed_patch a(mesh.positions, mesh.faces, all), b(moved, mesh.faces, all);
    for (const auto query : {Contact_query::all, Contact_query::first, Contact_query::yes_no}) {
      std::vector<Face_pair> expected{{7, 7}}, found{{7, 7}};
      const bool any = alone.confirm(a.posed, b.posed, query, expected);
      EXPECT_EQ(shared.confirm(a.posed, b.posed, query, found, five), any);
      EXPECT_EQ(found, expected);
      EXPECT_EQ(shared.exact_tests(), alone.exact_tests());
      (any ? found_any : found_none) += 1;
    }
  }
  EXPECT_GE(found_any, 6U);
  EXPECT_GE(found_none, 3U);
}

TEST(Confirmation, counts_exact_tests_until_reset) {
  const Numbered_mesh mesh(potato(4));
  std::vector<std::uint32_t> all(mesh.faces.size());
  for (std::uint32_t face = 0; face < all.size(); ++face) all[face] = face;
  const Placed_patch a(mesh.positions, mesh.faces, all), b(mesh.positions, mesh.faces, all);
  Confirmation confirmation;
  std::vector<Face_pair> found;
  confirmation.confirm(a.posed, b.posed, Contact_query::all, found);
  EXPECT_GE(confirmation.exact_tests(), found.size());
  EXPECT_LT(confirmation.exact_tests(), all.size() * all.size() / 2);
  confirmation.reset_count();
  EXPECT_EQ(confirmation.exact_tests(), 0U);
}

}  // namespace
}  // namespace lodestone
