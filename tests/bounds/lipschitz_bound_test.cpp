// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes from a promise about distances.
#include "lodestone/bounds/lipschitz_bound.h"

#include <gtest/gtest.h>

#include "lodestone/io/motion/deformed_points.h"
#include "lodestone/queries/bounded_search.h"
#include "support/exact_truth.h"
#include "support/face_soup.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

static_assert(Motion_bound<Lipschitz_bound<Deformed_points>>);

struct Ball {
  Surface_mesh mesh;
  std::vector<double> rest;
  Deformed_points points;
  std::vector<Corners> corners;
  Tree_surface tree;
  const Tree_layout& layout;

  Ball(Surface_mesh shape, const std::vector<Deformation>& deformations)
      : mesh(std::move(shape)),
        rest(Face_soup(mesh).coordinates),
        points(points_of(mesh), deformations),
        corners(Numbered_mesh(mesh).numbering.corners()),
        tree(corners, rest, {.leaf_faces = 12}),
        layout(tree.tree()) {}
  Ball(const Ball&) = delete;

  static std::vector<Point> points_of(const Surface_mesh& mesh) { return {mesh.points().begin(), mesh.points().end()}; }
  void set_frame(double frame) {
    points.set_frame(frame);
    for (const auto v : mesh.vertices()) {
      const Eigen::Vector3d moved = points(v);
      mesh.point(v) = Point(moved.x(), moved.y(), moved.z());
    }
  }
};

TEST(Lipschitz_bound, contains_every_position_if_the_promise_is_kept) {
  Ball ball(potato(9), {Inflate{.factor = 3, .frames = 10}, Spin{.degrees_per_frame = 33}});
  Lipschitz_bound bound(ball.points, ball.layout, ball.rest, 1);
  for (const double frame : {0.0, 1.0, 5.0, 20.0}) {
    ball.set_frame(frame);
    bound.set_constant((1 + 0.2 * std::min(frame, 10.0)) * (1 + 1e-12));
    Bounded_surface surface(ball.tree, ball.points, bound);
    for (std::uint32_t node = 0; node < ball.layout.node_count(); ++node) surface.box(node);
    surface.pose_all();  // compares all boxes
    EXPECT_EQ(surface.violations(), 0U) << frame;
    EXPECT_LT(bound.box(0).extent(), 3 * surface.box(0).extent());
  }
}

TEST(Lipschitz_bound, that_is_broken_is_noticed_where_surfaces_meet) {
  Ball a(potato(8, 1), {Inflate{.factor = 1.5, .frames = 10}}),
      b(potato(8, 2), {Travel{.way_points = {{0, {2.6, 0, 0}}}}});
  const Lipschitz_bound bound_a(a.points, a.layout, a.rest, 1), bound_b(b.points, b.layout, b.rest, 1);
  Bounded_surface surface_a(a.tree, a.points, bound_a), surface_b(b.tree, b.points, bound_b);
  Bounded_search search;
  std::size_t broken = 0;
  for (const double frame : {0.0, 4.0, 10.0}) {
    a.set_frame(frame);
    b.set_frame(frame);
    std::vector<Face_pair> found;
    search.run(surface_a, surface_b, {}, found);
    EXPECT_EQ(found, exhaustive_face_pairs(a.mesh, b.mesh)) << frame;
    EXPECT_EQ(surface_b.violations(), 0U);
    broken += surface_a.violations();
  }
  EXPECT_GT(broken, 0U);
}

TEST(Lipschitz_bound, refuses_what_is_no_constant) {
  Ball ball(potato(3), {});
  Lipschitz_bound bound(ball.points, ball.layout, ball.rest, 2);
  const Aabb before = bound.box(0);
  EXPECT_THROW(bound.set_constant(-1), Bad_argument);
  EXPECT_THROW(bound.set_constant(std::numeric_limits<double>::infinity()), Bad_argument);
  EXPECT_EQ(bound.box(0), before);
}

}  // namespace
}  // namespace lodestone
