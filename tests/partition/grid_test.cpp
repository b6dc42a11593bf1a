// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "partition/strategy_cases.h"

namespace lodestone {
namespace {

/// Checks that the regions are cubes of one size from the lower corner of the bounding box: coordinates of two vertices
/// of one region differ by less than a cube's size, and vertices of different regions are in different cubes along some
/// axis.
bool are_cubes_of_size(const Positions& positions, const std::vector<Region_index>& labels, double size) {
  const Positions offsets = positions.rowwise() - positions.colwise().minCoeff();
  const auto cube = [&](std::size_t v) {
    return (offsets.row(static_cast<Eigen::Index>(v)).array() / size).floor().eval();
  };
  for (std::size_t v = 0; v < labels.size(); ++v)
    for (std::size_t w = 0; w < v; ++w)
      if ((labels[v] == labels[w]) != (cube(v) == cube(w)).all()) return false;
  return true;
}

TEST(Grid, divides_a_flat_grid_into_squares) {
  // 16 x 16 vertices 1 apart: four cubes a side hold them, or five, but no number between.
  const auto mesh = grid(16, 16);
  for (const std::size_t wanted : {16, 17, 24}) {
    const auto labels = labels_of(Grid{}, mesh, wanted);
    EXPECT_EQ(different(labels), 16U);
    EXPECT_TRUE(are_cubes_of_size(Numbered_mesh(mesh).positions, labels, 4));
  }
}

TEST(Grid, makes_the_requested_number_of_regions_on_a_mesh_without_symmetry) {
  const auto mesh = potato(8);
  for (const std::size_t wanted : {1, 2, 3, 12, 32, 77, 128}) {
    const auto labels = labels_of(Grid{}, mesh, wanted);
    EXPECT_EQ(different(labels), wanted);
  }
}

TEST(Grid, regions_are_cubes_of_one_size) {
  const auto mesh = potato(5);
  const Numbered_mesh numbered(mesh);
  const auto labels = labels_of(Grid{}, mesh, 20);
  // Vertices enter or leave a cube at sizes that are a coordinate divided by an integer. So one of the sizes halfway
  // between two consecutive such sizes must give these regions.
  const Positions offsets = numbered.positions.rowwise() - numbered.positions.colwise().minCoeff();
  std::vector<double> sizes;
  for (Eigen::Index v = 0; v < offsets.rows(); ++v)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      for (int cubes = 1; cubes < 12; ++cubes) sizes.push_back(offsets(v, axis) / cubes);
  std::ranges::sort(sizes);
  bool found = false;
  for (std::size_t i = 0; i + 1 < sizes.size() && !found; ++i)
    found = sizes[i] > 0.1 && are_cubes_of_size(numbered.positions, labels, (sizes[i] + sizes[i + 1]) / 2);
  EXPECT_TRUE(found);
}

TEST(Grid, regions_are_numbered_by_x_then_y_then_z) {
  const auto labels = labels_of(Grid{}, cube(3), 8);
  const Numbered_mesh mesh(cube(3));
  ASSERT_EQ(different(labels), 8U);
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    const auto upper = [&](Eigen::Index axis) { return mesh.positions(v, axis) > 0.5 ? 1U : 0U; };
    EXPECT_EQ(labels[static_cast<std::size_t>(v)], 4 * upper(0) + 2 * upper(1) + upper(2));
  }
}

TEST(Grid, with_enough_regions_separates_all_vertices) {
  // One vertex per region, once cubes are smaller than the distance of two vertices.
  const auto mesh = grid(9, 4);
  EXPECT_EQ(different(labels_of(Grid{}, mesh, 36)), 36U);
}

TEST(Grid, is_in_the_registry) { expect_in_registry(Grid{}, {}); }

TEST(Grid, divides_awkward_meshes) {
  expect_sound_on_awkward_meshes(Grid{}, [](auto...) { return std::size_t{1}; });
  expect_invariant_under_translation_and_scale(Grid{});
}

}  // namespace
}  // namespace lodestone
