// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/tree_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/volumes/all.h"
#include "volumes/scene_division.h"
#include "volumes/tightness.h"

namespace lodestone {
namespace {

using Numbers = std::vector<double>;

/// Corners of a cube of side 2 around the origin.
const Numbers cube_points{-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1};
const std::vector<Corners> cube_faces{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

TEST(Hull_volume, equals_the_volume_of_the_convex_hull) {
  EXPECT_DOUBLE_EQ(hull_volume(cube_points), 8);
  EXPECT_DOUBLE_EQ(hull_volume(Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1}), 1.0 / 6);
  const std::vector<std::uint32_t> below{0, 1, 2, 4};
  EXPECT_DOUBLE_EQ(hull_volume(cube_points, below), 8.0 / 6);
}

TEST(Hull_volume, is_0_for_flat_point_sets) {
  EXPECT_EQ(hull_volume(Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}), 0);
  EXPECT_EQ(hull_volume(Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0}), 0);
  EXPECT_EQ(hull_volume(Numbers{0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}), 0);
  EXPECT_EQ(hull_volume(Numbers{1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}), 0);
}

TEST(Hull_volume, of_many_points_is_slightly_too_small_at_most) {
  const auto ball = icosphere(40);  // 16 002 vertices
  const Moving_mesh moving{&ball, {}};
  EXPECT_NEAR(hull_volume(moving.coordinates()) / (4.0 / 3 * std::numbers::pi), 1, 3e-3);
}

struct Divided_knot {
  explicit Divided_knot(std::size_t segments = 120, std::size_t sides = 10)
      : mesh(torus_knot({.segments = segments, .sides = sides})) {}

  Surface_mesh mesh;
  Mesh_numbering<Surface_mesh> numbering{mesh};
  Moving_mesh moving{&mesh, numbering.corners()};
  Scene_division division{"median_split", std::span(&moving, 1)};
  Region_tree tree{numbering.corners(), division.labels(0), moving.coordinates(), {}};
};

TEST(Tree_pieces, consist_of_the_faces_of_each_region) {
  const Divided_knot knot;
  const auto corners = knot.numbering.corners();
  const auto labels = knot.division.labels(0);
  const auto region_of = [&](std::uint32_t face) {
    const auto& [a, b, c] = corners[face];
    return std::min({labels[a], labels[b], labels[c]});
  };
  std::map<Region_index, std::multiset<std::uint32_t>> expected, found;
  for (std::uint32_t face = 0; face < corners.size(); ++face) expected[region_of(face)].insert(face);
  for (const auto& region : knot.division.pieces(0).regions)
    found[region_of(region.faces[0])].insert(region.faces.begin(), region.faces.end());
  EXPECT_EQ(expected.size(), division_regions);
  EXPECT_EQ(found, expected);
}

TEST(Tree_pieces, boxes_around_the_chosen_faces_are_those_of_the_region) {
  const Divided_knot knot(600, 40);  // 750 faces in a region
  for (const auto& region : knot.division.pieces(0).regions) {
    const auto chosen = choose_faces(region, knot.numbering.corners(), knot.moving.coordinates());
    EXPECT_LE(chosen.corners.size(), most_fitted_faces);
    EXPECT_LT(chosen.corners.size(), region.faces.size());
    EXPECT_TRUE(std::ranges::includes(region.vertices, chosen.vertices));
    Aabb fitted;
    fitted.enclose(chosen.posed(knot.moving.coordinates()));
    EXPECT_EQ(knot.tree.volume(region.node), fitted);  // boxes of boxes are as tight as boxes of faces
  }
}

TEST(Tree_pieces, all_faces_are_chosen_if_they_are_few) {
  const Divided_knot knot;
  for (const auto& region : knot.division.pieces(0).regions) {
    const auto chosen = choose_faces(region, knot.numbering.corners(), knot.moving.coordinates());
    EXPECT_EQ(chosen.vertices, region.vertices);
    ASSERT_EQ(chosen.corners.size(), region.faces.size());
    for (std::size_t i = 0; i < region.faces.size(); ++i)
      for (std::size_t corner = 0; corner < 3; ++corner)
        EXPECT_EQ(chosen.vertices[chosen.corners[i][corner]], knot.numbering.corners()[region.faces[i]][corner]);
  }
}

TEST(Tree_pieces, measured_leaves_are_spread_over_the_tree) {
  const auto ball = icosphere(100);  // 200 000 faces
  const Mesh_numbering<Surface_mesh> numbering(ball);
  const Moving_mesh moving{&ball, numbering.corners()};
  const Scene_division division("median_split", std::span(&moving, 1));
  const auto& leaves = division.pieces(0).leaves;
  const Region_tree tree(moving.corners, division.labels(0), moving.coordinates());
  ASSERT_GT(tree.leaf_count(), most_measured_leaves);
  EXPECT_EQ(leaves.size(), most_measured_leaves);
  EXPECT_EQ((std::set<std::uint32_t>(leaves.begin(), leaves.end()).size()), most_measured_leaves);
  EXPECT_GT(leaves.back(), tree.leaf_count() * 99 / 100);
  EXPECT_LT(leaves.back(), tree.leaf_count());
}

/// Tightness of a volume around the cube.
template <Bounding_volume Volume>
Tightness cube_tightness() {
  const std::vector<Region_index> labels(8, 0);
  const Basic_region_tree<Volume> tree(cube_faces, labels, cube_points);
  const auto pieces = pieces_of(tree, cube_faces, labels);
  const auto chosen = choose_faces(pieces.regions.at(0), cube_faces, cube_points);
  Volume_sums volumes;
  Hull_sums hulls;
  add_volumes(tree, pieces, cube_points, std::span(&chosen, 1), volumes);
  add_hulls(tree, pieces, cube_points, hulls);
  return tightness_of(volumes, hulls);
}

template <class... Volumes>
std::map<std::string_view, Tightness> cube_tightnesses(std::tuple<Volumes...>*) {
  return {{Volumes::name, cube_tightness<Volumes>()}...};
}

TEST(Tightness, of_a_cube_has_its_closed_form) {
  const auto found = cube_tightnesses(static_cast<Bounding_volumes*>(nullptr));
  const double ball = std::numbers::pi * std::numbers::sqrt3 / 2;
  for (const auto& [name, tightness] : found) {
    const bool is_slabs = name == "aabb" || name.starts_with("k_dop");
    for (const double figure : {tightness.leaves, tightness.regions, tightness.regions_refitted, tightness.objects}) {
      if (name != "spherical_shell") {
        EXPECT_GE(figure, 1 - 1e-9) << name;  // that one is not convex
      }
      if (is_slabs) {
        EXPECT_NEAR(figure, 1, 1e-9) << name;
      }
      if (name == "bounding_sphere") {
        EXPECT_NEAR(figure, ball, 0.03 * ball) << name;  // radius within one per cent
      }
    }
  }
  ASSERT_TRUE(found.contains("aabb"));
}

TEST(Tightness, is_a_ratio_of_sums) {
  const Tightness tightness = tightness_of({.leaves = 3, .regions = 8, .regions_refitted = 12, .objects = 5},
                                           {.leaves = 2, .regions = 4, .objects = 0});
  EXPECT_EQ(tightness.leaves, 1.5);
  EXPECT_EQ(tightness.regions, 2);
  EXPECT_EQ(tightness.regions_refitted, 3);
  EXPECT_EQ(tightness.objects, 0);
}

}  // namespace
}  // namespace lodestone
