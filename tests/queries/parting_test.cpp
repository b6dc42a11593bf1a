// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/parting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/face_soup.h"

namespace lodestone {
namespace {

bool one_in_the_other(const Face_soup& a, const Face_soup& b) {
  const Posed_object posed_a(a), posed_b(b);
  return encloses(posed_a.object(), posed_b.object()) || encloses(posed_b.object(), posed_a.object());
}

/// Checks that two objects are parted once a has been moved, or b the opposite way, with rounded coordinates; that
/// leaves of another size and another order of faces give a translation as short.
/// @return the translation of a
Parting expect_parted(const Face_soup& a, const Face_soup& b) {
  const auto found = parting(Posed_object(a).object(), Posed_object(b).object());
  if (!found) {
    ADD_FAILURE() << "no translation";
    return {};
  }
  const auto& [t, length] = *found;
  EXPECT_NEAR(length, t.stableNorm(), 1e-12 * length);
  for (const auto& [moved_a, moved_b] :
       {std::pair{moved(a, t.x(), t.y(), t.z()), b}, std::pair{a, moved(b, -t.x(), -t.y(), -t.z())}}) {
    EXPECT_TRUE(true_pairs(moved_a, moved_b).empty()) << length;
    EXPECT_FALSE(one_in_the_other(moved_a, moved_b)) << length;
  }
  for (const std::size_t leaf_faces : {2, 128}) {
    const auto other = parting(Posed_object(a, leaf_faces).object(), Posed_object(b, leaf_faces, false).object());
    EXPECT_EQ(other->translation, t);
  }
  return *found;
}

double expect_parted_length(const Face_soup& a, const Face_soup& b) {
  expect_parted(b, a);
  return expect_parted(a, b).length;
}

TEST(Parting, of_two_boxes_is_the_way_out_along_the_shortest_side_of_their_overlap) {
  const Face_soup box(cube(3));
  const Parting found = expect_parted(box, moved(box, 0.75, 0.25, -0.125));
  EXPECT_NEAR(found.length, 0.25, 1e-9);
  EXPECT_NEAR(found.translation.x(), -0.25, 1e-9);
  EXPECT_GT(found.length, 0.25) << "the faces would touch";
  EXPECT_NEAR(expect_parted(box, box).length, 1, 1e-9);
}

TEST(Parting, of_turned_boxes_is_found_along_a_normal_of_theirs) {
  Face_soup box(cube(2)), turned(cube(2));
  deform(turned, [](const Point& p) {
    const Eigen::Vector3d q = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()) *
                              Eigen::Vector3d(p.x() - 0.5, p.y() - 0.5, p.z() - 0.5);
    return Point(q.x() + 1.2, q.y() + 0.4, q.z() + 0.6);
  });
  // For convex bodies the least translation is along the normal of a face of either, or across an edge of each: all of
  // these directions are few enough to try.
  std::vector<Eigen::Vector3d> axes;
  for (const Face_soup* soup : {&box, &turned})
    for (std::size_t f = 0; f < soup->faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const Point p = soup->triangle(f)[k], q = soup->triangle(f)[(k + 1) % 3];
        axes.emplace_back(q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
      }
  double least = std::numeric_limits<double>::infinity();
  for (const auto& e : axes)
    for (const auto& f : axes) {
      const Eigen::Vector3d n = e.cross(f);
      if (n.norm() < 1e-9) continue;
      const auto range = [&](const Face_soup& soup) {
        const Eigen::VectorXd along = soup.positions() * n.normalized();
        return std::pair(along.minCoeff(), along.maxCoeff());
      };
      least = std::min(least, range(box).second - range(turned).first);
    }
  const double found = expect_parted_length(box, turned);
  EXPECT_GT(found, least - 1e-12);
  EXPECT_LT(found, 1.02 * least);
}

TEST(Parting, of_two_spheres_is_what_their_radii_exceed_their_distance_by) {
  const Face_soup ball(icosphere(12)), other = placed(ball, 0.5);
  for (const double distance : {0.3, 0.8, 1.3}) {
    const double expected = 1.5 - distance;
    const double x = distance * 0.6, y = distance * 0.64, z = distance * 0.48;
    const double found = expect_parted_length(ball, moved(other, x, y, z));
    EXPECT_LT(found, 1.02 * expected);
    EXPECT_GT(found, 0.98 * expected);  // the spheres are polyhedra inside round ones
  }
}

TEST(Parting, of_a_small_body_deep_inside_a_large_one_leads_out_the_short_way) {
  const Face_soup ball(icosphere(10)), pea = placed(icosphere(3), 0.1);
  const Parting out = expect_parted(moved(pea, 0.5, 0, 0), ball);
  EXPECT_NEAR(out.length, 0.6, 0.01);
  EXPECT_NEAR(out.translation.x(), 0.6, 0.01);
  expect_parted_length(ball, pea);
  Face_soup plate(cube(4));
  deform(plate, [](const Point& p) { return Point(8 * p.x() - 2, 8 * p.y() - 3, p.z()); });
  const Parting through = expect_parted(moved(pea, 1.3, 0.2, 0.3), plate);
  EXPECT_NEAR(through.length, 0.4, 0.01);
  EXPECT_NEAR(through.translation.z(), -0.4, 0.01);
}

TEST(Parting, of_linked_rings_leads_them_apart) {
  const Face_soup ring(torus_knot({.p = 1, .q = 0, .tube = 0.2, .segments = 40, .sides = 6}));
  Face_soup other = ring;
  deform(other, [](const Point& p) { return Point(p.x() + 1, p.z(), p.y()); });
  ASSERT_TRUE(true_pairs(ring, other).empty());
  EXPECT_FALSE(parting(Posed_object(ring).object(), Posed_object(other).object())) << "linked without contact";
  expect_parted_length(ring, moved(other, 1.8, 0, 0.1));
  expect_parted_length(ring, moved(other, -0.9, 0.1, 0.2));
}

TEST(Parting, parts_objects_of_many_kinds_in_any_pose) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  std::size_t parted = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (std::size_t j = i; j < objects.size(); ++j) {
      SCOPED_TRACE(objects[i].first + ", " + objects[j].first);
      const Face_soup& a = objects[i].second;
      const Face_soup b = crumpled(posed_at_random(objects[j].second, 0.5, random), 0.02, i);
      if (true_pairs(a, b).empty() && !one_in_the_other(a, b)) continue;
      expect_parted(a, b);
      ++parted;
    }
  EXPECT_GT(parted, 10U);
}

TEST(Parting, of_a_sheet_through_a_sphere_leads_it_out) {
  const Face_soup ball(icosphere(6)), sheet = moved(placed(Face_soup(cloth(12, 12)), 4), -2, -2, 0.9);
  EXPECT_LT(expect_parted_length(ball, sheet), 0.2);
  Face_soup wavy = sheet;
  deform(wavy, [](const Point& p) { return Point(p.x(), p.y(), p.z() + 0.3 * std::sin(5 * p.x())); });
  expect_parted_length(ball, wavy);
}

TEST(Parting, scales_with_powers_of_two) {
  const Face_soup a(potato(5)), b = moved(Face_soup(torus_knot({.segments = 40, .sides = 6})), 0.7, 0.2, 0.1);
  const Parting found = expect_parted(a, b);
  for (const double factor : {0x1p-900, 0x1p-300, 0x1p300, 0x1p900})
    EXPECT_EQ(expect_parted(placed(a, factor), placed(b, factor)).translation, factor * found.translation);
}

TEST(Parting, holds_far_from_the_origin_and_in_the_smallest_units) {
  const Face_soup a(potato(5)), b = moved(Face_soup(icosphere(5)), 0.9, 0.3, 0.2);
  const double near = expect_parted(a, b).length;
  for (const double offset : {0x1p10, 0x1p20, 0x1p40})
    EXPECT_NEAR(expect_parted_length(placed(a, 1, offset), placed(b, 1, offset)), near, 1e-9 + offset * 0x1p-44);
  expect_parted_length(placed(a, 0x1p-1070), placed(b, 0x1p-1070));
  const Face_soup point = placed(single_triangle(), 0);
  expect_parted_length(point, point);
}

TEST(Parting, parts_surfaces_that_touch_or_coincide) {
  const Face_soup box(cube(2)), flat(cloth(4, 4)), triangle(single_triangle());
  EXPECT_NEAR(expect_parted_length(box, moved(box, 1, 0, 0)), 0, 1e-9);
  EXPECT_NEAR(expect_parted_length(box, moved(box, 1, 1, 1)), 0, 1e-9);
  EXPECT_NEAR(expect_parted_length(flat, flat), 0, 1e-9);
  EXPECT_NEAR(expect_parted_length(triangle, triangle), 0, 1e-9);
}

TEST(Parting, of_objects_apart_is_none) {
  const Face_soup ball(icosphere(4));
  EXPECT_FALSE(parting(Posed_object(ball).object(), Posed_object(moved(ball, 3, 0, 0)).object()));
  const Face_soup hollow = joined(placed(ball, 3), placed(ball, 2));
  EXPECT_FALSE(parting(Posed_object(hollow).object(), Posed_object(ball).object())) << "in a hollow";
}

TEST(Parting, of_what_lies_inside_finds_the_way_out_through_a_narrow_pit) {
  // The pit of a ball ends near a small body inside. It leads along no axis, no diagonal, and not along the line
  // between the middles of both: a second ball, far away, belongs to the outer object.
  const Eigen::Vector3d pit = Eigen::Vector3d(1, 0.45, 0.2).normalized(), place = -0.5 * pit.unitOrthogonal();
  Face_soup ball(sphere(80));
  deform(ball, [&](const Point& p) {
    const Eigen::Vector3d away = Eigen::Vector3d(p.x(), p.y(), p.z()) - place;
    if (away.normalized().dot(pit) < std::cos(0.12)) return p;
    const Eigen::Vector3d end = place + 0.2 * away / away.dot(pit);
    return Point(end.x(), end.y(), end.z());
  });
  const Face_soup outer = joined(ball, moved(icosphere(2), 3, -8, 5));
  const Face_soup inner = moved(placed(icosphere(2), 0.005), place.x(), place.y(), place.z());
  const Parting found = expect_parted(inner, outer);
  EXPECT_LT(found.length, 0.22);
  EXPECT_GT(found.translation.normalized().dot(pit), 0.99);
}

}  // namespace
}  // namespace lodestone
