// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/containment.h"

#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <gtest/gtest.h>

#include "lodestone/mesh/errors.h"
#include "support/arm.h"
#include "support/face_soup.h"

namespace lodestone {
namespace {

/// Whether `outer` encloses `inner`, whatever the leaf size, the order of vertices, the scale and the position.
bool encloses(const Face_soup& outer, const Face_soup& inner) {
  std::vector<bool> answers;
  for (const std::size_t leaf_faces : {2, 16, 128})
    answers.push_back(encloses(Posed_object(outer, leaf_faces).object(), Posed_object(inner).object()));
  for (const auto& [factor, offset] : {std::pair{0x1p-300, 0.0}, {0x1p300, 0.0}, {1.0, 0x1p20}})
    answers.push_back(encloses(Posed_object(placed(outer, factor, offset)).object(),
                               Posed_object(placed(inner, factor, offset)).object()));
  answers.push_back(encloses(Posed_object(shuffled(outer, 1)).object(), Posed_object(shuffled(inner, 2)).object()));
  for (const bool answer : answers) EXPECT_EQ(answer, answers[0]);
  return answers[0];
}

TEST(Containment, a_sphere_encloses_a_smaller_one_and_not_the_reverse) {
  const Face_soup ball(icosphere(5)), pea = placed(icosphere(3), 0.25);
  EXPECT_TRUE(encloses(ball, pea));
  EXPECT_TRUE(encloses(ball, moved(pea, 0.3, -0.4, 0.2)));
  EXPECT_FALSE(encloses(pea, ball));
}

TEST(Containment, what_lies_outside_is_not_enclosed_on_any_side) {
  const Face_soup ball(icosphere(5)), pea = placed(icosphere(3), 0.25);
  for (const auto& [x, y, z] : {std::array{2.0, 0.0, 0.0}, {0.0, -2.0, 0.0}, {0.0, 0.0, 2.0}, {0.0, 0.0, -2.0}})
    EXPECT_FALSE(encloses(ball, moved(pea, x, y, z)));
  for (const double x : {-0.8, 0.8})
    for (const double y : {-0.8, 0.8})
      for (const double z : {-0.8, 0.8})
        EXPECT_FALSE(encloses(ball, moved(placed(icosphere(2), 0.0625), x, y, z))) << "in a corner of its box";
  EXPECT_FALSE(encloses(torus_knot({.p = 1, .q = 0}), placed(icosphere(2), 0.1))) << "in the hole";
}

TEST(Containment, a_hollow_does_not_enclose_and_a_core_in_it_does) {
  const Face_soup pea = placed(icosphere(3), 0.125);
  const Face_soup ball(icosphere(5)), hollow = joined(ball, placed(ball, 0.5)),
                                      core = joined(hollow, placed(ball, 0.25));
  EXPECT_FALSE(encloses(hollow, pea));
  EXPECT_TRUE(encloses(core, pea));
  EXPECT_TRUE(encloses(hollow, moved(pea, 0, 0, 0.7))) << "in the shell";
  EXPECT_TRUE(encloses(hollow, placed(ball, 0.75))) << "around the hollow";
  EXPECT_FALSE(encloses(ball, joined(hollow, placed(ball, 2))));
}

TEST(Containment, every_component_must_be_inside) {
  const Face_soup ball(icosphere(5)), pea = placed(icosphere(2), 0.125);
  const Face_soup inside[]{pea, moved(pea, 0.5, 0, 0), moved(pea, 0, 0, -0.5)}, outside = moved(pea, 0, 0, -3);
  const auto all_in = joined(joined(inside[0], inside[1]), inside[2]);
  EXPECT_TRUE(encloses(ball, all_in));
  EXPECT_FALSE(encloses(ball, joined(all_in, outside)));
  EXPECT_FALSE(encloses(ball, joined(outside, all_in)));
  const auto in_a_corner = moved(placed(pea, 0.5), 0.8, 0.8, 0.8);  // of the ball's box, but outside of it
  EXPECT_FALSE(encloses(ball, joined(all_in, in_a_corner)));
  EXPECT_FALSE(encloses(ball, joined(in_a_corner, all_in)));
  const auto two = joined(ball, moved(ball, 4, 0, 0));
  EXPECT_TRUE(encloses(two, joined(all_in, moved(all_in, 4, 0, 0)))) << "one in each";
  EXPECT_FALSE(encloses(two, moved(all_in, 2, 0, 0)));
}

TEST(Containment, an_open_surface_encloses_nothing) {
  const Face_soup pea = moved(placed(icosphere(2), 0.125), 0.5, 0.5, -0.5);
  EXPECT_FALSE(encloses(cloth(9, 9), pea));
  Face_soup ball(icosphere(5));
  ball.faces.pop_back();
  EXPECT_FALSE(encloses(ball, placed(icosphere(2), 0.125)));
  EXPECT_FALSE(encloses(joined(icosphere(5), moved(cloth(3, 3), 9, 0, 0)), placed(icosphere(2), 0.125)));
}

TEST(Containment, a_closed_surface_encloses_an_open_one) {
  const Face_soup sheet = moved(cloth(9, 9), -0.5, -0.5, 0);
  EXPECT_TRUE(encloses(icosphere(5), sheet));
  EXPECT_FALSE(encloses(icosphere(5), moved(sheet, 0, 0, 1.5)));
}

TEST(Containment, is_exact_below_vertices_and_edges) {
  // All vertices of a cube's sides lie above or below each other, and above those of the inner cube.
  const Face_soup box(cube(4)), small = placed(cube(4), 0.5, 0.25), tiny = placed(cube(2), 0.25, 0.25);
  EXPECT_TRUE(encloses(box, small));
  EXPECT_TRUE(encloses(box, tiny));
  for (const double z : {-2.0, -1.0, 1.0, 2.0}) {
    EXPECT_FALSE(encloses(box, moved(small, 0, 0, z)));
    EXPECT_FALSE(encloses(box, moved(tiny, 0, 0, z)));
  }
  EXPECT_FALSE(encloses(box, moved(tiny, 0, 1, 0))) << "in line with a vertical side";
  const Face_soup ball(icosphere(4));
  EXPECT_TRUE(encloses(placed(ball, 2), ball));
  EXPECT_FALSE(encloses(placed(ball, 2), moved(ball, 0, 0, -4)));
}

TEST(Containment, of_points_equals_cgal) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.5, 1.5);
  std::size_t inside = 0, outside = 0;
  for (const auto& mesh : {icosphere(5), uv_sphere(12, 9), torus_knot(), cube(3), potato(5)}) {
    const CGAL::Side_of_triangle_mesh<Surface_mesh, Kernel> side(mesh);
    for (const std::size_t leaf_faces : {2, 32}) {
      const Posed_object object(Face_soup(mesh), leaf_faces);
      const auto vertex = [&] { return object.soup().point(random() % object.soup().vertex_count()); };
      for (int trial = 0; trial < 1500; ++trial) {
        Point p(unit(random), unit(random), unit(random));
        const Point v = vertex(), w = vertex();
        if (trial % 4 == 1) p = Point(v.x(), v.y(), p.z());                              // in line with a vertex
        if (trial % 4 == 2) p = Point((v.x() + w.x()) / 2, (v.y() + w.y()) / 2, w.z());  // often with an edge
        if (trial % 4 == 3) p = Point(v.x(), w.y(), v.z());
        const auto truth = side(p);
        const auto found = point_side(object.object(), p);
        ASSERT_EQ(found == Point_side::inside, truth == CGAL::ON_BOUNDED_SIDE) << p;
        ASSERT_EQ(found == Point_side::on_surface, truth == CGAL::ON_BOUNDARY) << p;
        ASSERT_EQ(encloses(object.object(), p), truth == CGAL::ON_BOUNDED_SIDE) << p;
        ++(truth == CGAL::ON_BOUNDED_SIDE ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 2000U);
  EXPECT_GT(outside, 2000U);
}

TEST(Containment, follows_the_vertices) {
  const Face_soup ball(icosphere(5)), pea = placed(icosphere(3), 0.25);
  Posed_object outer(ball), inner(moved(pea, 3, 0, 0));
  EXPECT_FALSE(encloses(outer.object(), inner.object()));
  inner.move_to(pea);
  EXPECT_TRUE(encloses(outer.object(), inner.object()));
  outer.move_to(moved(ball, 0, 0, 5));
  EXPECT_FALSE(encloses(outer.object(), inner.object()));
}

TEST(Containment, of_points_on_faces_edges_and_vertices_is_on_the_surface) {
  for (const auto& mesh : {cube(4), icosphere(4), torus_knot(), cloth(5, 5)}) {
    const Posed_object object(Face_soup(mesh), 8);
    const Face_soup& soup = object.soup();
    for (std::uint32_t face = 0; face < soup.faces.size(); ++face)
      for (const Point& corner : soup.triangle(face))
        EXPECT_EQ(point_side(object.object(), corner), Point_side::on_surface);
  }
  const Posed_object box(Face_soup(cube(2)), 2);
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 0.25, 0.5, 0.75})
      for (const double z : {0.0, 0.125, 0.5, 1.0}) {
        EXPECT_EQ(point_side(box.object(), Point(x, y, z)), Point_side::on_surface);
        EXPECT_EQ(point_side(box.object(), Point(y, x, z)), Point_side::on_surface);
        EXPECT_EQ(point_side(box.object(), Point(z, y, x)), Point_side::on_surface);
      }
  EXPECT_EQ(point_side(box.object(), Point(0.5, 0.5, std::nextafter(1.0, 0.0))), Point_side::inside);
  EXPECT_EQ(point_side(box.object(), Point(0.5, 0.5, std::nextafter(1.0, 2.0))), Point_side::outside);
}

TEST(Containment, refuses_points_that_are_not_finite) {
  const Posed_object box(Face_soup(cube(2)), 2);
  for (const double x : {std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(point_side(box.object(), Point(0, x, 0)), Bad_argument);
}

TEST(Containment, of_points_in_bounded_surfaces_equals_that_in_fitted_ones) {
  std::mt19937_64 random(6);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  int inside = 0;
  for (const std::size_t leaf_faces : {4, 40}) {
    Arm arm(long_potato(8, 1), true, leaf_faces);
    for (int round = 0; round < 10; ++round) {
      arm.pose(number(), {number(), 0, 0});
      const Posed_object fitted{Face_soup(arm.mesh)};
      for (int trial = 0; trial < 50; ++trial) {
        const Point v = fitted.soup().point(random() % fitted.soup().vertex_count());
        const Point p = trial == 0 ? v : Point(0.9 * v.x(), v.y() + 0.3 * number(), v.z() + 0.3 * number());
        const auto truth = point_side(fitted.object(), p);
        EXPECT_EQ(point_side(arm.surface, p), truth);
        inside += truth == Point_side::inside ? 1 : 0;
      }
    }
  }
  EXPECT_GT(inside, 50);
}

/// Whether `outer` encloses `inner`, each bounded and each fitted.
bool encloses_bounded(Bounded_surface& outer, Bounded_surface& inner, const Arm& outer_arm, const Arm& inner_arm) {
  const bool truth =
      encloses(Posed_object(Face_soup(outer_arm.mesh)).object(), Posed_object(Face_soup(inner_arm.mesh)).object());
  EXPECT_EQ(encloses(outer, inner), truth);
  return truth;
}

/// A small potato in one end of a long one, at a distance from where it is inside.
Surface_mesh pit(double away = 0) {
  Surface_mesh mesh = long_potato(4, 2);
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    mesh.point(v) = Point(0.05 * p.x() - 1.5, 0.1 * p.y() + away, 0.1 * p.z());
  }
  return mesh;
}

TEST(Containment, of_bounded_surfaces_equals_that_of_fitted_ones) {
  const Surface_mesh small = pit();
  Arm outer(long_potato(8, 1), true), inner(small, false), open(cloth(5, 5), false);
  int inside = 0;
  const auto ask = [](Arm& a, Arm& b) { return encloses_bounded(a.surface, b.surface, a, b); };
  for (int round = 0; round < 30; ++round) {
    const double angle = 0.05 * round;
    outer.pose(angle, {0, 0, 0});
    inner.pose(angle, {0, 0.2 * (round % 10), 0});
    open.pose(0, {0, 0, 0});
    inside += ask(outer, inner) ? 1 : 0;
    EXPECT_FALSE(ask(inner, outer));
    EXPECT_FALSE(ask(open, inner));
  }
  EXPECT_GT(inside, 5);
  EXPECT_LT(inside, 25);
}

TEST(Containment, of_bounded_surfaces_needs_a_closed_one_around_every_component) {
  Surface_mesh last_outside = pit(), first_outside = pit(3), pierced = long_potato(8, 1);
  last_outside += pit(3);
  first_outside += pit();
  CGAL::Euler::remove_face(halfedge(*std::prev(faces(pierced).end()), pierced), pierced);
  pierced.collect_garbage();
  Arm outer(long_potato(8, 1), true), inner(pit(), false), last(last_outside, false), first(first_outside, false),
      open(pierced, true);
  const auto ask = [](Arm& a, Arm& b) { return encloses_bounded(a.surface, b.surface, a, b); };
  for (const double angle : {0.0, 0.1, 0.2}) {
    for (Arm* const arm : {&outer, &inner, &last, &first, &open}) arm->pose(angle, {0, 0, 0});
    EXPECT_TRUE(ask(outer, inner));
    EXPECT_FALSE(ask(outer, last));
    EXPECT_FALSE(ask(outer, first));
    EXPECT_FALSE(ask(open, inner));
  }
}

TEST(Containment, in_surfaces_far_away_poses_nothing) {
  Arm outer(long_potato(8, 1), true), inner(long_potato(4, 2), false);
  outer.pose(0.3, {0, 0, 0});
  inner.pose(0.3, {9, 0, 0});
  EXPECT_FALSE(encloses_bounded(outer.surface, inner.surface, outer, inner));
  EXPECT_EQ(outer.surface.vertices_posed() + inner.surface.vertices_posed(), 0U);
}

TEST(Containment, refuses_a_bounded_surface_with_a_vertex_that_is_not_finite) {
  Arm outer(long_potato(8, 1), true), inner(pit(), false);
  outer.pose(0, {0, 0, 0});
  inner.pose(0, {0, 0, 0});
  const Aabb where_it_was = inner.bound.box(0);
  struct Lie {
    std::size_t nodes;
    Aabb whole;
    std::size_t node_count() const { return nodes; }
    Aabb box(std::uint32_t) const { return whole; }
  };
  const Lie lie{inner.layout.node_count(), where_it_was};
  Tree_surface tree = inner.tree;
  Bounded_surface surface(tree, inner.points, lie);
  EXPECT_TRUE(encloses(outer.surface, surface));
  inner.points.set_joints(std::vector<Eigen::Affine3d>(3, Eigen::Affine3d(Eigen::Scaling(1.7e308))));
  EXPECT_THROW(encloses(outer.surface, surface), Bad_mesh);
}

TEST(Containment, is_right_where_a_broken_bound_is_noticed) {
  Arm arm(long_potato(10, 1), false);
  arm.pose(0.4, {0, 0, 0});
  const Posed_object fitted{Face_soup(arm.mesh)};
  int broken = 0;
  for (std::uint32_t from = 0; from < arm.bound.node_count(); from += 3) {
    const Shrunk_bound lie{arm.bound, from};
    Tree_surface tree = arm.tree;
    Bounded_surface surface(tree, arm.points, lie);
    for (std::uint32_t leaf = 0; leaf < arm.layout.leaf_count(); ++leaf) {
      const Aabb box = arm.bound.box(arm.layout.leaf_node(leaf));
      const Point p(box.low[0] / 2 + box.high[0] / 2, box.low[1] / 2 + box.high[1] / 2, 0);  // below a shrunk box
      const auto found = point_side(surface, p);
      if (surface.violations() == 0) continue;
      ++broken;
      EXPECT_EQ(found, point_side(fitted.object(), p));
    }
  }
  EXPECT_GT(broken, 10);
}

}  // namespace
}  // namespace lodestone
