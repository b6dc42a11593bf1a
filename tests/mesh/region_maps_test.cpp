// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/region_maps.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>
#include <gtest/gtest.h>

#include <vector>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Values = std::vector<Region_index>;
constexpr auto none = no_particle;

template <class Mesh, class Map>
Values values_of(const Mesh& mesh, const Map& map) {
  Values values;
  for (const auto v : vertices(mesh)) values.push_back(get(map, v));
  return values;
}

/// A strip of eight vertices, in two regions of four.
template <class Mesh>
Mesh strip() {
  Mesh mesh;
  CGAL::copy_face_graph(grid(4, 2), mesh);
  return mesh;
}

template <class Mesh>
class Region_maps_of : public testing::Test {};
using Mesh_types = testing::Types<Surface_mesh, Polyhedron>;
TYPED_TEST_SUITE(Region_maps_of, Mesh_types);

TYPED_TEST(Region_maps_of, give_the_region_of_each_vertex_and_the_region_whose_particle_is_there) {
  auto mesh = strip<TypeParam>();
  const Mesh_numbering<TypeParam> numbering(mesh);
  Region_maps<TypeParam> maps(mesh);
  const Values labels{1, 1, 0, 0, 1, 1, 0, 0};
  maps.write(numbering, labels, {3, 4});
  EXPECT_EQ(values_of(mesh, maps.region()), labels);
  EXPECT_EQ(values_of(mesh, maps.particle()), (Values{none, none, none, 0, 1, none, none, none}));
}

TYPED_TEST(Region_maps_of, moving_particles_clear_their_old_vertex_and_keep_the_regions) {
  auto mesh = strip<TypeParam>();
  const Mesh_numbering<TypeParam> numbering(mesh);
  Region_maps<TypeParam> maps(mesh);
  const Values labels{1, 1, 0, 0, 1, 1, 0, 0};
  maps.write(numbering, labels, {3, 4});
  maps.move_particles(numbering, {7, 4});
  EXPECT_EQ(values_of(mesh, maps.particle()), (Values{none, none, none, none, 1, none, none, 0}));
  maps.move_particles(numbering, {2, 1});
  EXPECT_EQ(values_of(mesh, maps.particle()), (Values{none, 1, 0, none, none, none, none, none}));
  EXPECT_EQ(values_of(mesh, maps.region()), labels);
}

TYPED_TEST(Region_maps_of, a_particle_may_step_to_a_vertex_that_another_has_just_left) {
  auto mesh = strip<TypeParam>();
  const Mesh_numbering<TypeParam> numbering(mesh);
  Region_maps<TypeParam> maps(mesh);
  maps.write(numbering, Values(8, 0), {3, 4, 5});
  maps.move_particles(numbering, {4, 3, 6});
  EXPECT_EQ(values_of(mesh, maps.particle()), (Values{none, none, none, 1, 0, none, 2, none}));
}

TYPED_TEST(Region_maps_of, a_new_partition_replaces_the_old_one) {
  auto mesh = strip<TypeParam>();
  const Mesh_numbering<TypeParam> numbering(mesh);
  Region_maps<TypeParam> maps(mesh);
  maps.write(numbering, {0, 1, 2, 2, 0, 1, 2, 2}, {0, 1, 2});
  maps.write(numbering, Values(8, 0), {6});
  EXPECT_EQ(values_of(mesh, maps.region()), Values(8, 0));
  EXPECT_EQ(values_of(mesh, maps.particle()), (Values{none, none, none, none, none, none, 0, none}));
  maps.move_particles(numbering, {5});
  EXPECT_EQ(values_of(mesh, maps.particle()), (Values{none, none, none, none, none, 0, none, none}));
}

TEST(Region_maps, other_code_finds_the_maps_of_a_surface_mesh_by_name) {
  auto mesh = strip<Surface_mesh>();
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  Region_maps<Surface_mesh> maps(mesh);
  const auto region = mesh.property_map<Surface_mesh::Vertex_index, Region_index>("v:region");
  const auto particle = mesh.property_map<Surface_mesh::Vertex_index, Region_index>("v:particle");
  ASSERT_TRUE(region.second && particle.second);
  EXPECT_EQ(values_of(mesh, particle.first), Values(8, none));
  maps.write(numbering, Values(8, 0), {2});
  EXPECT_EQ(values_of(mesh, region.first), Values(8, 0));
  EXPECT_EQ(values_of(mesh, particle.first), (Values{none, none, 0, none, none, none, none, none}));
}

TEST(Region_maps, a_surface_mesh_keeps_its_maps_when_they_are_made_again) {
  auto mesh = strip<Surface_mesh>();
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  Region_maps<Surface_mesh>(mesh).write(numbering, Values(8, 3), {2});
  Region_maps<Surface_mesh> again(mesh);
  EXPECT_EQ(values_of(mesh, again.region()), Values(8, 3));
  again.write(numbering, Values(8, 0), {5});
  EXPECT_EQ(values_of(mesh, again.particle()), (Values{none, none, none, none, none, 0, none, none}));
}

}  // namespace
}  // namespace lodestone
