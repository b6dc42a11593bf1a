// SPDX-License-Identifier: GPL-3.0-or-later
// Searches within one object for faces that are near.
#include <gtest/gtest.h>

#include <functional>

#include "queries/searches.h"
#include "support/distance_oracle.h"

namespace lodestone {
namespace {

bool share_a_vertex(const Corners& a, const Corners& b) { return std::ranges::find_first_of(a, b) != a.end(); }

/// Whether two triangles are nearer than a distance, by their boxes or else by their exact squared distance.
bool exactly_nearer(const Triangle& a, const Triangle& b, double distance) {
  const auto box = [](const Triangle& t) {
    Box bounds;
    for (const Point& p : t) bounds.extend(Eigen::Vector3d(p.x(), p.y(), p.z()));
    return bounds;
  };
  return distance_lower_bound(box(a), box(b)) < distance &&
         exact_squared_distance(a, b) < Rational(distance) * Rational(distance);
}

/// The contacts within a surface that has been in another pose at rest: every face against every other.
std::vector<Face_pair> by_definition(const Face_soup& now, const Face_soup& rest, double tolerance) {
  std::vector<Face_pair> pairs;
  for (std::uint32_t a = 0; a < now.faces.size(); ++a)
    for (std::uint32_t b = a + 1; b < now.faces.size(); ++b) {
      const Triangle p = now.triangle(a), q = now.triangle(b);
      const bool became_near = !share_a_vertex(now.faces[a], now.faces[b]) && exactly_nearer(p, q, tolerance) &&
                               !exactly_nearer(rest.triangle(a), rest.triangle(b), 2 * tolerance);
      if (became_near || faces_intersect(now.faces[a], p, now.faces[b], q)) pairs.push_back({a, b});
    }
  return pairs;
}

/// A surface at rest, and another pose of it.
struct Motion {
  std::string name;
  Face_soup rest, now;
};

Motion motion(const std::string& name, const Face_soup& rest, const std::function<Point(const Point&)>& map) {
  Motion result{name, rest, rest};
  deform(result.now, map);
  return result;
}

std::vector<Motion> motions() {
  const Face_soup sheet(cloth(8, 3)), ball(sphere(2));
  std::vector<Motion> result;
  result.push_back(motion("a sheet folded in two", sheet, [](const Point& p) {
    return Point(std::abs(p.x() - 0.45), p.y(), p.x() < 0.45 ? 0.0 : 0.07);
  }));
  result.push_back(motion("a sheet rolled up", sheet, [](const Point& p) {
    return Point((0.15 + 0.01 * p.x()) * std::cos(12 * p.x()), (0.15 + 0.01 * p.x()) * std::sin(12 * p.x()), p.y());
  }));
  result.push_back(
      motion("a sheet that shrinks", sheet, [](const Point& p) { return Point(0.8 * p.x(), 0.8 * p.y(), p.z()); }));
  result.push_back(
      motion("a ball pressed flat", ball, [](const Point& p) { return Point(p.x(), p.y(), 0.1 * p.z()); }));
  result.push_back({"a crumpled ball", ball, crumpled(ball, 0.2, 1)});
  result.push_back({"a crumpled sheet", sheet, crumpled(sheet, 0.1, 2)});
  const Face_soup soup = lattice_soup(24, 20, 4, 3);
  result.push_back({"loose faces", soup, crumpled(soup, 0.3, 4)});
  return result;
}

std::size_t expect_by_definition(const Motion& motion, double tolerance) {
  SCOPED_TRACE(motion.name + ", " + std::to_string(tolerance));
  const auto truth = by_definition(motion.now, motion.rest, tolerance);
  for (const std::size_t leaf_faces : {2, 16, 128}) {
    Posed_object object(motion.rest, leaf_faces);
    object.keep_rest();
    object.move_to(motion.now);
    for (const std::size_t threads : {1, 2}) {
      Searcher searcher(threads);
      expect_answers(truth, tolerance,
                     [&](const Contact_request& request) { return searcher.within(object, request); });
    }
  }
  return truth.size();
}

TEST(Self_tolerance, finds_the_faces_that_exhaustive_exact_checking_finds) {
  std::size_t found = 0;
  for (const auto& motion : motions())
    for (const double tolerance : {0.08, 0.3}) found += expect_by_definition(motion, tolerance);
  EXPECT_GT(found, 200U);
}

TEST(Self_tolerance, finds_the_same_in_any_unit_and_far_from_the_origin) {
  for (const auto& motion : motions())
    for (const auto& [factor, offset] : {std::pair{0x1p-300, 0.0}, {1.0, 0x1p20}})
      expect_by_definition({motion.name, placed(motion.rest, factor, offset), placed(motion.now, factor, offset)},
                           0.08 * factor);
}

TEST(Self_tolerance, leaves_out_what_is_near_at_rest) {
  for (const auto& soup : {Face_soup(cloth(12, 12)), Face_soup(icosphere(4)), Face_soup(teapot({2, 2}))}) {
    Posed_object object(soup);
    object.keep_rest();
    for (const double tolerance : {0.01, 0.1, 1.0, 1e308})
      EXPECT_EQ(search_within(object, {.tolerance = tolerance}).found, search_within(object).found) << tolerance;
  }
}

TEST(Self_tolerance, counts_everything_near_where_no_rest_is_kept) {
  const Posed_object object(Face_soup(cloth(4, 4)));
  std::vector<Face_pair> truth;
  const auto& faces = object.soup().faces;
  for (std::uint32_t a = 0; a < faces.size(); ++a)
    for (std::uint32_t b = a + 1; b < faces.size(); ++b)
      if (!share_a_vertex(faces[a], faces[b])) truth.push_back({a, b});
  EXPECT_EQ(search_within(object, {.tolerance = 2}).found, truth);
}

TEST(Self_tolerance, finds_the_same_with_any_number_of_workers) {
  const Face_soup sheet(cloth(70, 60));
  Posed_object object(sheet, 32);
  object.keep_rest();
  Face_soup folded = sheet;
  deform(folded, [](const Point& p) {
    return Point(std::abs(p.x() - 0.5), p.y(), 0.004 * std::sin(40 * p.x()) + 0.003 * std::sin(31 * p.y()));
  });
  object.move_to(folded);
  const std::size_t contacts = search_within(object, {.tolerance = 0.01}).found.size();
  EXPECT_GT(contacts, search_within(object).found.size() + 100);
  expect_same_for_any_workers(
      contacts, [&](Searcher& searcher, const Contact_request& request) { return searcher.within(object, request); });
}

}  // namespace
}  // namespace lodestone
