// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/containment.h"

#include <CGAL/Side_of_triangle_mesh.h>
#include <gtest/gtest.h>

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
        if (truth == CGAL::ON_BOUNDARY) continue;
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

}  // namespace
}  // namespace lodestone
