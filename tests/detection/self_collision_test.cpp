// SPDX-License-Identifier: GPL-3.0-or-later
// Collisions of an object with itself against CGAL's self-intersections.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lodestone/io/shapes/shapes.h"
#include "support/cgal_self_intersections.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// Plays a few frames of one mesh; gives the number of pairs in each.
std::vector<std::size_t> expect_equal_to_cgal(Surface_mesh mesh, const std::function<void(Surface_mesh&, int)>& move,
                                              int frames = 5) {
  Exact_detector detector(self_collision);
  detector.add(mesh);
  std::vector<std::size_t> found;
  for (int frame = 0; frame < frames; ++frame) {
    move(mesh, frame);
    const auto truth = self_intersections_by_cgal(mesh);
    const Frame& result = detector.detect();
    EXPECT_EQ(result.pairs.size(), 1U);
    expect_contacts(result, 0, 0, truth);
    expect_contacts(detector.detect(0, 0), 0, 0, truth);
    found.push_back(truth.size());
  }
  return found;
}

TEST(Self_collision, equals_cgal_on_crumpled_cloth) {
  const auto found =
      expect_equal_to_cgal(cloth(24, 20), [](Surface_mesh& mesh, int frame) { crumple(mesh, 0.01 * frame, 5); });
  EXPECT_EQ(found.front(), 0U);
  EXPECT_GT(found.back(), 1000U);
}

TEST(Self_collision, equals_cgal_on_sheets_that_fold_over) {
  // The right half turns over the left one; at the end both lie in one plane.
  const auto flat = cloth(16, 16);
  const auto found = expect_equal_to_cgal(flat, [&](Surface_mesh& mesh, int frame) {
    const double angle = frame < 4 ? 0.95 * frame : M_PI;
    for (const auto v : flat.vertices()) {
      const Point& p = flat.point(v);
      const double far = std::max(0.0, p.x() - 0.5);
      mesh.point(v) = frame == 4 ? Point(0.5 - std::abs(p.x() - 0.5), p.y(), 0)
                                 : Point(std::min(p.x(), 0.5) + far * std::cos(angle), p.y(), far * std::sin(angle));
    }
  });
  EXPECT_EQ(found.front(), 0U);
  EXPECT_GT(found.back(), 500U);
}

TEST(Self_collision, equals_cgal_on_a_sheet_rolled_into_itself) {
  const auto flat = cloth(60, 8);
  const auto found = expect_equal_to_cgal(flat, [&](Surface_mesh& mesh, int frame) {
    for (const auto v : flat.vertices()) {
      const Point& p = flat.point(v);
      const double angle = 2.5 * frame * p.x(), radius = 1 + 0.03 * std::sin(9 * p.y()) - 0.01 * std::cos(7 * p.x());
      mesh.point(v) = Point(radius * std::cos(angle), radius * std::sin(angle), p.y());
    }
  });
  EXPECT_EQ(found[1], 0U);
  EXPECT_GT(found.back(), 50U);
}

TEST(Self_collision, equals_cgal_on_torus_knots_that_pass_through_themselves) {
  for (const double tube : {0.2, 0.5, 0.6}) {
    const auto found = expect_equal_to_cgal(
        torus_knot({.tube = tube, .segments = 120, .sides = 10}), [](Surface_mesh& mesh, int frame) {
          if (frame == 0) return;
          deform(mesh, [](const Point& p) {
            return Point(p.x() + 0.1 * std::sin(3 * p.y()), p.y() + 0.1 * std::sin(3 * p.z()),
                         p.z() + 0.1 * std::sin(3 * p.x()));
          });
        });
    EXPECT_EQ(found.front() > 50, tube > 0.4);
  }
}

TEST(Self_collision, equals_cgal_on_a_body_pushed_through_itself_in_any_unit) {
  for (const double unit : {1.0, 0x1p-300, 0x1p300}) {
    auto body = potato(14);
    scale(body, unit);
    const auto found = expect_equal_to_cgal(body, [unit](Surface_mesh& mesh, int frame) {
      if (frame == 0) return;
      deform(mesh, [unit](const Point& p) {
        const double x = p.x() / unit, y = p.y() / unit, z = p.z() / unit;
        return Point(p.x(), p.y(), unit * (z - 0.7 * std::copysign(std::exp(-4 * (x * x + y * y)), z)));
      });
    });
    EXPECT_EQ(found.front(), 0U);
    EXPECT_GT(found.back(), 20U);
  }
}

/// A crumpled cloth, a knot that passes through itself, a sphere that does not; all of them meet.
struct Three_bodies {
  Surface_mesh cloth_mesh = cloth(20, 20), knot = torus_knot({.tube = 0.5}), ball = sphere(8, 0.7);
  Meshes meshes{&cloth_mesh, &knot, &ball};
  Three_bodies() { crumple(cloth_mesh, 0.03, 3); }
};

TEST(Self_collision, stands_beside_collisions_with_other_objects) {
  const Three_bodies bodies;
  Exact_detector detector(self_collision);
  add_all(detector, bodies.meshes);
  const Frame& frame = detector.detect();
  EXPECT_EQ(expect_exhaustive(frame, bodies.meshes), 3U);
  std::vector<std::pair<Object_id, Object_id>> listed;
  for (const auto& pair : frame.pairs) listed.emplace_back(pair.a, pair.b);
  EXPECT_EQ(listed, (std::vector<std::pair<Object_id, Object_id>>{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}));
  for (Object_id id = 0; id < 3; ++id) expect_contacts(frame, id, id, self_intersections_by_cgal(*bodies.meshes[id]));
  EXPECT_TRUE(result_of(frame, 0, 0)->collides);
  EXPECT_TRUE(result_of(frame, 1, 1)->collides);
  EXPECT_FALSE(result_of(frame, 2, 2)->collides);
}

TEST(Self_collision, is_not_looked_for_unless_asked_for) {
  const Three_bodies bodies;
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, bodies.meshes);
  for (const auto& pair : detector.detect().pairs) EXPECT_LT(pair.a, pair.b);
  expect_contacts(detector.detect(1, 1), 1, 1, self_intersections_by_cgal(bodies.knot));  // asked for
}

TEST(Self_collision, does_not_depend_on_the_tolerance) {
  const auto knot = torus_knot({.tube = 0.5});
  auto options = self_collision;
  options.exact.tolerance = 0.5;
  Exact_detector detector(options);
  detector.add(knot);
  expect_contacts(detector.detect(), 0, 0, self_intersections_by_cgal(knot));
}

TEST(Self_collision, can_be_left_out_for_single_objects) {
  const Three_bodies bodies;
  Exact_detector detector(self_collision);
  detector.add(bodies.cloth_mesh);
  detector.add(bodies.knot, {.groups = 2, .meets = 1 | 4});  // not its own group
  detector.add(bodies.ball, {.groups = 4});
  detector.ignore(0, 0);
  const Frame& frame = detector.detect();
  EXPECT_EQ(result_of(frame, 0, 0), nullptr);
  EXPECT_EQ(result_of(frame, 1, 1), nullptr);
  EXPECT_NE(result_of(frame, 2, 2), nullptr);
  EXPECT_EQ(expect_exhaustive(frame, bodies.meshes), 3U);
  EXPECT_TRUE(detector.detect(1, 1).pairs.empty());
  detector.ignore(0, 0, false);
  expect_contacts(detector.detect(), 0, 0, self_intersections_by_cgal(bodies.cloth_mesh));
}

TEST(Self_collision, answers_yes_or_no_and_lists_the_first_or_so_many) {
  const auto knot = torus_knot({.tube = 0.5}), ball = sphere(8, 0.7);
  const auto truth = self_intersections_by_cgal(knot);
  ASSERT_GT(truth.size(), 20U);
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all}) {
    auto options = self_collision;
    options.contacts = query;
    options.most_contacts = 20;
    Exact_detector detector(options);
    add_all(detector, {&knot, &ball});
    const Frame frame = detector.detect(0, 0);
    ASSERT_EQ(frame.pairs.size(), 1U);
    EXPECT_TRUE(frame.collides());
    const std::size_t listed = query == Contact_query::all ? 20 : query == Contact_query::first ? 1 : 0;
    EXPECT_EQ(frame.face_pairs.size(), listed);
    EXPECT_EQ(frame.capped(), query == Contact_query::all);
    EXPECT_TRUE(std::ranges::includes(truth, frame.face_pairs));
    EXPECT_FALSE(detector.detect(1, 1).collides());
  }
}

}  // namespace
}  // namespace lodestone
