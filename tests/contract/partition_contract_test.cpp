// SPDX-License-Identifier: GPL-3.0-or-later
// The partition stage on every mesh type.
#include <algorithm>

#include "contract/divided.h"
#include "contract/mesh_types.h"
#include "lodestone/particles/hop_metric.h"
#include "lodestone/partition/lbg.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

template <class Mesh>
struct Partition_contract : ::testing::Test {};
TYPED_TEST_SUITE(Partition_contract, Mesh_types);

TYPED_TEST(Partition_contract, vertices_and_faces_have_the_same_indices_on_every_mesh_type) {
  const auto source = as_float(potato(4));
  const auto mesh = converted<TypeParam>(source);
  const Mesh_numbering<TypeParam> numbering(mesh);
  const Mesh_numbering<Surface_mesh> expected(source);
  EXPECT_EQ(read_positions(numbering, get(CGAL::vertex_point, mesh)), read_positions(expected, source.points()));
  ASSERT_EQ(numbering.corners().size(), expected.corners().size());
  for (std::size_t face = 0; face < expected.corners().size(); ++face) {
    Corners corners = numbering.corners()[face];
    std::rotate(corners.begin(), std::ranges::find(corners, expected.corners()[face][0]), corners.end());
    EXPECT_EQ(corners, expected.corners()[face]);
  }
  for (std::uint32_t v = 0; v < numbering.vertex_count(); ++v) EXPECT_EQ(numbering.index(numbering.vertex(v)), v);
}

TYPED_TEST(Partition_contract, every_vertex_has_one_region_and_every_region_is_connected) {
  const auto source = as_float(potato(7));
  const Numbered_mesh numbered(source);
  for (const std::size_t regions : {1, 5, 24}) {
    const auto divided = divide(converted<TypeParam>(source), regions, Lbg{});
    EXPECT_EQ(divided.regions, regions);
    for (const auto& pieces : pieces_of(numbered.graph, divided.labels, regions)) EXPECT_EQ(pieces.size(), 1U);
    ASSERT_EQ(divided.particles.size(), regions);
    for (Region_index region = 0; region < regions; ++region)
      EXPECT_EQ(divided.labels[divided.particles[region]], region);
  }
}

TYPED_TEST(Partition_contract, regions_are_the_same_on_every_mesh_type_and_in_every_run) {
  const auto source = as_float(potato(7));
  const auto mesh = converted<TypeParam>(source);
  for (const bool keep_islands : {false, true}) {
    const auto expected = divide(source, 20, Lbg{}, {.keep_islands = keep_islands});
    for (int run = 0; run < 2; ++run) {
      const auto divided = divide(mesh, 20, Lbg{}, {.keep_islands = keep_islands});
      EXPECT_EQ(divided.labels, expected.labels);
      EXPECT_EQ(divided.particles, expected.particles);
    }
  }
}

TYPED_TEST(Partition_contract, open_borders_and_several_components_are_divided) {
  auto source = grid(6, 6);
  append(source, sphere(2, 1, {20, 0, 0}));
  const auto divided = divide(converted<TypeParam>(source), 7, Lbg{});
  for (const auto& pieces : pieces_of(Numbered_mesh(source).graph, divided.labels, divided.regions))
    EXPECT_EQ(pieces.size(), 1U);
}

TYPED_TEST(Partition_contract, bad_meshes_are_refused) {
  EXPECT_THROW(divide(TypeParam(), 3, Lbg{}), Bad_mesh);
  auto source = sphere(2);
  source.point(Surface_mesh::Vertex_index(1)) = Point(0, std::numeric_limits<double>::infinity(), 0);
  EXPECT_THROW(divide(converted<TypeParam>(source), 3, Lbg{}), Bad_mesh);
}

TYPED_TEST(Partition_contract, hops_are_those_of_the_grid) {
  const auto mesh = converted<TypeParam>(grid(6, 5));
  const Mesh_numbering<TypeParam> numbering(mesh);
  const std::vector<Vertex<TypeParam>> targets{numbering.vertex(5), numbering.vertex(24)};
  EXPECT_EQ(hop_diameter(mesh, std::span<const Vertex<TypeParam>>(targets)), 9U);
}

}  // namespace
}  // namespace lodestone
