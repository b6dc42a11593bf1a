// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// Ascending and without repeats.
bool strictly_ascending(const std::vector<std::uint32_t>& list) {
  return std::ranges::adjacent_find(list, std::greater_equal()) == list.end();
}

void expect_corners_of(const Patch& patch, std::span<const Corners> faces) {
  EXPECT_TRUE(strictly_ascending(patch.faces));
  EXPECT_TRUE(strictly_ascending(patch.vertices));
  ASSERT_EQ(patch.corners.size(), patch.faces.size());
  std::set<std::uint32_t> used;
  for (std::size_t i = 0; i < patch.faces.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      ASSERT_LT(patch.corners[i][c], patch.vertices.size());
      EXPECT_EQ(patch.vertices[patch.corners[i][c]], faces[patch.faces[i]][c]);
      used.insert(faces[patch.faces[i]][c]);
    }
  EXPECT_EQ(used.size(), patch.vertices.size());
}

TEST(Make_patch, lists_each_vertex_of_its_faces_once) {
  const auto faces = grid_faces(5, 5);
  const auto patch = make_patch({2, 3, 10, 11}, faces);
  EXPECT_EQ(patch.faces, (std::vector<std::uint32_t>{2, 3, 10, 11}));
  EXPECT_EQ(patch.vertices, (std::vector<std::uint32_t>{1, 2, 6, 7, 11, 12}));  // two squares one above the other
  expect_corners_of(patch, faces);
}

TEST(Region_patches, contain_every_face_in_each_region_of_its_corners) {
  std::mt19937_64 random(1);
  const Numbered_mesh mesh(potato(6));
  for (const std::size_t regions : {1, 2, 7, 50}) {
    std::vector<Region_index> labels(mesh.numbering.vertex_count());
    for (auto& label : labels) label = static_cast<Region_index>(random() % regions);
    const auto patches = region_patches(mesh.faces, labels, regions);
    ASSERT_EQ(patches.size(), regions);
    for (Region_index region = 0; region < regions; ++region) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
        if (std::ranges::any_of(mesh.faces[face], [&](auto corner) { return labels[corner] == region; }))
          expected.push_back(face);
      EXPECT_EQ(patches[region].faces, expected);
      expect_corners_of(patches[region], mesh.faces);
    }
  }
}

TEST(Region_patches, lose_no_face_at_a_seam) {
  const Numbered_mesh mesh(grid(6, 6));
  std::vector<Region_index> labels;
  for (std::uint32_t v = 0; v < 36; ++v) labels.push_back(v % 3);
  std::vector<int> times(mesh.faces.size(), 0);
  for (const auto& patch : region_patches(mesh.faces, labels, 3))
    for (const auto face : patch.faces) ++times[face];
  for (std::size_t face = 0; face < times.size(); ++face) {
    const std::set<Region_index> regions{labels[mesh.faces[face][0]], labels[mesh.faces[face][1]],
                                         labels[mesh.faces[face][2]]};
    EXPECT_EQ(times[face], static_cast<int>(regions.size()));
  }
}

TEST(Pose_patch, reads_each_vertex_once_per_frame_and_bounds_them) {
  const Numbered_mesh mesh(potato(4));
  const std::vector<Region_index> labels(mesh.numbering.vertex_count(), 0);
  const auto patch = region_patches(mesh.faces, labels, 1)[0];
  std::size_t reads = 0;
  double shift = 0;
  const auto reader = [&](std::uint32_t v) {
    ++reads;
    return Eigen::Vector3d(mesh.positions.row(v).transpose() + Eigen::Vector3d(shift, 0, 0));
  };
  Posed_patch posed;
  posed.patch = &patch;
  pose_patch(posed, reader, 1);
  EXPECT_EQ(reads, patch.vertices.size());
  EXPECT_TRUE(posed.box.min().isApprox(mesh.positions.colwise().minCoeff().transpose(), 0));
  EXPECT_TRUE(posed.box.max().isApprox(mesh.positions.colwise().maxCoeff().transpose(), 0));

  shift = 5;
  pose_patch(posed, reader, 1);  // same frame: nothing is read again
  EXPECT_EQ(reads, patch.vertices.size());
  pose_patch(posed, reader, 2);
  EXPECT_EQ(reads, 2 * patch.vertices.size());
  EXPECT_EQ(posed.box.min().x(), (mesh.positions.col(0).array() + 5).minCoeff());
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) EXPECT_EQ(posed.positions[i], reader(patch.vertices[i]));
}

}  // namespace
}  // namespace lodestone
