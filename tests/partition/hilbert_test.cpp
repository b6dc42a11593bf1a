// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/hilbert.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "partition/strategy_cases.h"

namespace lodestone {
namespace {

TEST(Hilbert, runs_are_of_equal_size) {
  for (const auto& mesh : {grid(7, 5), potato(7)})
    for (const std::size_t regions : {1, 2, 3, 8, 12, 33}) {
      const auto sizes = sizes_of(labels_of(Hilbert{}, mesh, regions));
      EXPECT_EQ(sizes.size(), regions);
      EXPECT_LE(*std::ranges::max_element(sizes) - *std::ranges::min_element(sizes), 1U);
    }
}

TEST(Hilbert, eight_runs_are_octants_and_consecutive_ones_share_a_face) {
  // A lattice of 4 x 4 x 4 points has its medians between the second and third along every axis.
  Surface_mesh mesh;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z) mesh.add_vertex({1.0 * x, 1.0 * y, 1.0 * z});
  using Index = Surface_mesh::Vertex_index;
  for (unsigned v = 0; v + 2 < 64; v += 3) mesh.add_face(Index(v), Index(v + 1), Index(v + 2));
  mesh.add_face(Index(61), Index(60), Index(63));
  const auto labels = labels_of(Hilbert{}, mesh, 8);
  std::vector<std::array<int, 3>> octants(8);
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    const std::array<int, 3> octant{p.x() > 1.5, p.y() > 1.5, p.z() > 1.5};
    auto& of_label = octants[labels[v.idx()]];
    if (std::ranges::find(labels, labels[v.idx()]) - labels.begin() == v.idx()) of_label = octant;
    EXPECT_EQ(octant, of_label) << v;
  }
  for (std::size_t run = 0; run + 1 < 8; ++run) {
    int differing = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) differing += octants[run][axis] != octants[run + 1][axis];
    EXPECT_EQ(differing, 1) << run;
  }
}

TEST(Hilbert, with_as_many_runs_as_vertices_each_has_one_vertex) {
  EXPECT_EQ(different(labels_of(Hilbert{}, potato(4), 66)), 66U);
}

TEST(Hilbert, is_in_the_registry) { expect_in_registry(Hilbert{}, {}); }

TEST(Hilbert, divides_awkward_meshes) {
  expect_sound_on_awkward_meshes(Hilbert{}, always_as_wanted);
  expect_invariant_under_translation_and_scale(Hilbert{});
}

}  // namespace
}  // namespace lodestone
