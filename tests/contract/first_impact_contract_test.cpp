// SPDX-License-Identifier: GPL-3.0-or-later
// The first impact of two meshes is the same for every mesh type.
#include <limits>

#include "contract/mesh_types.h"
#include "lodestone/find_first_impact.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/message_of.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

template <class Mesh>
Moving_surface surface_of(const Mesh_numbering<Mesh>& numbering, const Positions& start, const Positions& end) {
  const auto coordinates = [](const Positions& p) { return Coordinates(p.data(), static_cast<std::size_t>(p.size())); };
  return {numbering.corners(), coordinates(start), coordinates(end)};
}

template <class Mesh>
struct First_impact_contract : ::testing::Test {};
TYPED_TEST_SUITE(First_impact_contract, Mesh_types);

TYPED_TEST(First_impact_contract, of_one_mesh_is_the_same_for_every_mesh_type_and_for_exhaustive_checking) {
  const auto mesh = converted<TypeParam>(as_float(potato(5)));
  const auto end = moved_points(mesh, 0, 0, 0);  // turned inside out along x
  for (const auto v : vertices(mesh)) {
    const auto p = coordinates(get(end, v));
    put(end, v, Point(-p.x(), p.y(), p.z()));
  }
  const auto found = find_first_self_impact(mesh, end);
  ASSERT_TRUE(found);
  const Mesh_numbering<TypeParam> numbering(mesh);
  const auto own = get(CGAL::vertex_point, mesh);
  const auto truth = exhaustive_first_self_impact(
      surface_of(numbering, read_positions(numbering, own), read_positions(numbering, end)));
  ASSERT_TRUE(truth);
  EXPECT_GT(found->time, 0);
  EXPECT_LT(found->time, 1);
  EXPECT_EQ(found->time, truth->time);
  EXPECT_EQ(found->faces, truth->faces);
  EXPECT_EQ(found->point, truth->point);
  EXPECT_FALSE(find_first_self_impact(mesh, own));
  EXPECT_FALSE(find_first_self_impact(mesh, own, CGAL::parameters::vertex_point_map(moved_points(mesh, 1, 2, 3))));
}

TYPED_TEST(First_impact_contract, is_the_same_for_every_mesh_type_and_for_exhaustive_checking) {
  const Surface_mesh ball = as_float(potato(4)), knot = as_float(torus_knot({.segments = 20, .sides = 5}));
  const auto a = converted<TypeParam>(ball), b = converted<TypeParam>(knot);
  const auto start_a = moved_points(a, 0, 0, -4), end_a = moved_points(a, 0, 0.5, 1);
  const auto end_b = moved_points(b, 0.5, 0, 0);
  const auto found = find_first_impact(a, end_a, b, end_b, CGAL::parameters::vertex_point_map(start_a));
  ASSERT_TRUE(found);

  const Mesh_numbering<TypeParam> number_a(a), number_b(b);
  const auto truth = exhaustive_first_impact(
      surface_of(number_a, read_positions(number_a, start_a), read_positions(number_a, end_a)),
      surface_of(number_b, read_positions(number_b, get(CGAL::vertex_point, b)), read_positions(number_b, end_b)));
  ASSERT_TRUE(truth);
  EXPECT_GT(found->time, 0);
  EXPECT_LT(found->time, 1);
  EXPECT_EQ(found->time, truth->time);
  EXPECT_EQ(found->faces, truth->faces);
  EXPECT_EQ(found->point, truth->point);

  const auto mixed =
      find_first_impact(a, end_a, knot, moved_points(knot, 0.5, 0, 0), CGAL::parameters::vertex_point_map(start_a));
  ASSERT_TRUE(mixed);
  EXPECT_EQ(mixed->time, truth->time);
  EXPECT_FALSE(find_first_impact(a, moved_points(a, 0, 0, -9), b, end_b, CGAL::parameters::vertex_point_map(start_a)));
}

TYPED_TEST(First_impact_contract, refuses_what_is_no_motion_of_two_meshes) {
  const auto a = converted<TypeParam>(tetrahedron()), b = converted<TypeParam>(tetrahedron());
  const auto end_a = moved_points(a, 1, 0, 0);
  auto end_b = moved_points(b, 0, 1, 0);
  EXPECT_THROW(find_first_impact(a, end_a, a, end_a), Bad_argument);
  EXPECT_THROW(find_first_impact(TypeParam(), end_a, b, end_b), Bad_mesh);
  put(end_b, *std::next(vertices(b).begin(), 2), Point(0, std::numeric_limits<double>::quiet_NaN(), 0));
  EXPECT_EQ(message_of<Bad_mesh>([&] { find_first_impact(a, end_a, b, end_b); }),
            "vertex 2 of the second mesh, at the end, has a coordinate that is not finite");
}

}  // namespace
}  // namespace lodestone
