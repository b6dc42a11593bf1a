// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/impact_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lodestone/triangles/triangle_distance.h"
#include "support/face_soup.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

/// An object that moves.
struct Moving_soup {
  Face_soup start, end;

  explicit Moving_soup(Face_soup from, Face_soup to) : start(std::move(from)), end(std::move(to)) {}

  Moving_surface surface() const { return {start.faces, start.coordinates, end.coordinates}; }
  /// At a time; exact if the coordinates allow it.
  Face_soup at(double t) const {
    Face_soup soup = start;
    for (std::size_t i = 0; i < soup.coordinates.size(); ++i)
      soup.coordinates[i] = std::lerp(start.coordinates[i], end.coordinates[i], t);
    return soup;
  }
  double largest_coordinate() const {
    double largest = 0;
    for (const auto* soup : {&start, &end})
      for (const double x : soup->coordinates) largest = std::max(largest, std::abs(x));
    return largest;
  }
};

Moving_soup still(const Face_soup& soup) { return Moving_soup(soup, soup); }
Moving_soup shifted(const Face_soup& soup, double x, double y, double z) {
  return Moving_soup(soup, moved(soup, x, y, z));
}

void expect_equal(const std::optional<Impact>& found, const std::optional<Impact>& truth) {
  ASSERT_EQ(found.has_value(), truth.has_value());
  if (!truth) return;
  EXPECT_EQ(found->time, truth->time);
  EXPECT_EQ(found->exact_time, truth->exact_time);
  EXPECT_EQ(found->faces, truth->faces);
  EXPECT_EQ(found->point, truth->point);
}

void expect_point_on_both(const Moving_soup& a, const Moving_soup& b, const Impact& impact) {
  const double error = 0x1p-46 * std::max(a.largest_coordinate(), b.largest_coordinate());
  const Triangle point{impact.point, impact.point, impact.point};
  EXPECT_LE(closest_points(a.at(impact.time).triangle(impact.faces.a), point).distance, error);
  EXPECT_LE(closest_points(b.at(impact.time).triangle(impact.faces.b), point).distance, error);
}

/// Compares the search with exhaustive checking in both orders and with several leaf sizes.
/// @return the time; infinity: never
double expect_impact(const Moving_soup& first, const Moving_soup& second) {
  const auto check = [](const Moving_soup& a, const Moving_soup& b) {
    const auto truth = exhaustive_first_impact(a.surface(), b.surface());
    for (const std::size_t leaf_faces : {2, 10, 128}) {
      const Posed_object tree_a(a.start, leaf_faces), tree_b(b.start, 8, false);
      const Swept_boxes boxes_a(tree_a.view(), a.end.coordinates), boxes_b(tree_b.view(), b.end.coordinates);
      expect_equal(first_impact(boxes_a.view(), boxes_b.view()), truth);
    }
    expect_equal(first_impact(a.surface(), b.surface()), truth);
    if (truth) expect_point_on_both(a, b, *truth);
    return truth ? truth->time : infinity;
  };
  const double time = check(first, second);
  EXPECT_EQ(check(second, first), time);
  return time;
}

/// Objects of a few dozen faces, to be moved.
std::vector<Face_soup> moving_objects() {
  return {icosphere(2),
          Face_soup(potato(3)),
          torus_knot({.p = 1, .q = 0, .segments = 8, .sides = 5}),
          cloth(6, 5),
          loose_triangles(40, 0.4, 1),
          lattice_soup(30, 30, 4, 1),
          Face_soup(single_triangle())};
}

TEST(Impact_search, equals_exhaustive_checking_for_any_motion) {
  std::mt19937_64 random(1);
  int meet = 0, apart = 0, at_start = 0;
  const auto objects = moving_objects();
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (std::size_t j = i; j < objects.size(); ++j)
      for (const double distance : {0.5, 3.0}) {
        SCOPED_TRACE(testing::Message() << i << ' ' << j << ' ' << distance);
        const auto pose = [&](const Face_soup& soup) { return posed_at_random(soup, distance, random); };
        const auto a = Moving_soup(moved(pose(objects[i]), -1, 0, 0), pose(objects[i]));
        const auto b = Moving_soup(moved(pose(objects[j]), 2, 0, 0), crumpled(pose(objects[j]), 0.1, i));
        const double time = expect_impact(a, b);
        ++(time == infinity ? apart : time == 0 ? at_start : meet);
      }
  EXPECT_GT(meet, 20);
  EXPECT_GT(apart, 2);
  EXPECT_GT(at_start, 1);
}

/// Compares the search within an object with exhaustive checking, with several leaf sizes.
/// @return the time; infinity: never
double expect_self_impact(const Moving_soup& object) {
  const auto truth = exhaustive_first_self_impact(object.surface());
  for (const std::size_t leaf_faces : {2, 10, 128}) {
    const Posed_object tree(object.start, leaf_faces);
    expect_equal(first_self_impact(Swept_boxes(tree.view(), object.end.coordinates).view()), truth);
  }
  expect_equal(first_self_impact(object.surface()), truth);
  if (truth) {
    EXPECT_LT(truth->faces.a, truth->faces.b);
    expect_point_on_both(object, object, *truth);
  }
  return truth ? truth->time : infinity;
}

TEST(Self_impact, equals_exhaustive_checking_for_any_motion) {
  std::mt19937_64 random(3);
  int meet = 0, apart = 0, at_start = 0;
  for (const auto& object : moving_objects())
    for (const double strength : {0.01, 0.5, 2.0})
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        SCOPED_TRACE(testing::Message() << object.faces.size() << ' ' << strength << ' ' << seed);
        const double time = expect_self_impact(Moving_soup(object, crumpled(object, strength, seed)));
        ++(time == infinity ? apart : time == 0 ? at_start : meet);
      }
  EXPECT_GT(meet, 10);
  EXPECT_GT(apart, 3);
  EXPECT_GT(at_start, 3);
}

TEST(Self_impact, of_a_sheet_that_folds_is_where_its_halves_meet) {
  const Face_soup sheet(cloth(9, 9));
  Face_soup folded = sheet;
  double middle = 0;
  for (std::size_t i = 0; i < sheet.coordinates.size(); i += 3) middle += sheet.coordinates[i];
  middle *= 3.0 / static_cast<double>(sheet.coordinates.size());
  // One half turns over onto the other: its far part sinks below it, its near part stays above.
  for (std::size_t i = 0; i < sheet.coordinates.size(); i += 3) {
    const double beyond = folded.coordinates[i] - middle;
    if (beyond <= 0) continue;
    folded.coordinates[i] = middle - beyond;
    folded.coordinates[i + 2] += 0.25 - beyond;
  }
  const double time = expect_self_impact(Moving_soup(sheet, folded));
  EXPECT_GT(time, 0);
  EXPECT_LT(time, 1);
}

TEST(Self_impact, leaves_out_faces_that_share_a_vertex) {
  // A hinge that closes: its two faces have an edge in common.
  const std::vector<Corners> hinge{{0, 1, 2}, {1, 0, 3}};
  const std::vector<double> open{0, 0, 0, 0, 1, 0, 1, 0, 0, -1, 0, 0}, closed{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0.25, 0};
  EXPECT_FALSE(first_self_impact({hinge, open, closed}));
  // The same faces without a common vertex touch at the start.
  const std::vector<Corners> apart{{0, 1, 2}, {4, 5, 3}};
  std::vector<double> touching = open;
  touching.insert(touching.end(), {0, 1, 0, 0, 0, 0});
  const auto found = first_self_impact({apart, touching, touching});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->time, 0);
}

TEST(Self_impact, of_two_cones_of_one_mesh_is_where_the_tips_meet_or_where_they_cross_at_the_start) {
  const auto two_cones = [](double gap) {
    return joined(fan_of_faces(24, {0, 0, gap}, -0.5), fan_of_faces(25, {0.01, 0.02, 0}, 0.5));
  };
  const Face_soup apart = two_cones(1), crossing = two_cones(-0.25);
  const double time = expect_self_impact(Moving_soup(apart, crossing));
  EXPECT_GT(time, 0.7);  // on one axis the tips would meet at 0.8; they are a little beside each other
  EXPECT_LT(time, 0.9);
  EXPECT_EQ(expect_self_impact(Moving_soup(crossing, apart)), 0);
  // Faces of one cone share its tip, wherever they go.
  const Face_soup cone = fan_of_faces(24, {0, 0, 0}, 0.5);
  EXPECT_EQ(expect_self_impact(Moving_soup(cone, moved(fan_of_faces(24, {0, 0, 0}, -3), 0, 0, 1))), infinity);
}

TEST(Impact_search, of_two_cones_that_cross_at_the_start_is_the_lowest_pair_there) {
  const Face_soup a = fan_of_faces(24, {0, 0, -0.25}, -0.5), b = fan_of_faces(25, {0.01, 0.02, 0}, 0.5);
  EXPECT_EQ(expect_impact(still(a), shifted(b, 0, 0, -3)), 0);
  EXPECT_EQ(first_impact(still(a).surface(), shifted(b, 0, 0, -3).surface())->faces, true_pairs(a, b).front());
}

TEST(Self_impact, of_what_moves_as_one_piece_is_none) {
  for (const Surface_mesh& mesh : {icosphere(6), cloth(12, 10), potato(5)}) {
    const Face_soup soup(mesh);
    EXPECT_EQ(expect_self_impact(shifted(soup, 3, 0.1, -7)), infinity);
    EXPECT_EQ(expect_self_impact(still(soup)), infinity);
  }
}

TEST(Impact_search, on_a_lattice_finds_nothing_before_the_impact_and_the_impact) {
  std::mt19937_64 random(2);
  int meet = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto pose = [&](double x) { return moved(lattice_soup(12, 12, 4, random()), x, 0, 0); };
    Moving_soup a(pose(0), pose(1)), b(pose(4), pose(0));
    a.end.faces = a.start.faces, b.end.faces = b.start.faces;
    const double time = expect_impact(a, b);
    if (time != infinity && time > 0) ++meet;
    for (int i = 0; i <= 16; ++i)
      EXPECT_TRUE(i / 16.0 >= time || true_pairs(a.at(i / 16.0), b.at(i / 16.0)).empty()) << i;
  }
  EXPECT_GT(meet, 20);
}

TEST(Impact_search, of_many_impacts_at_the_same_time_reports_the_lowest_pair) {
  const Face_soup box(cube(2)), sheet(cloth(4, 4));
  EXPECT_EQ(expect_impact(still(box), Moving_soup(moved(box, 2, 0, 0), box)), 0.5);
  EXPECT_EQ(expect_impact(still(box), Moving_soup(moved(box, 2, 0, 0), moved(box, -1, 0, 0))), 1.0 / 3);
  EXPECT_EQ(expect_impact(still(sheet), Moving_soup(moved(sheet, 0, 0, 1), moved(sheet, 0, 0, -1))), 0.5);
  EXPECT_EQ(expect_impact(still(shuffled(sheet, 1)),
                          Moving_soup(moved(shuffled(sheet, 2), 0, 0, 1), moved(shuffled(sheet, 2), 0, 0, -2))),
            1.0 / 3);
}

TEST(Impact_search, of_objects_that_intersect_at_the_start_is_there) {
  const Face_soup box(cube(3)), ball(icosphere(2));
  for (const auto& [a, b] : {std::pair(box, box), std::pair(box, moved(box, 1, 1, 1)), std::pair(box, ball)}) {
    EXPECT_EQ(expect_impact(still(a), Moving_soup(b, moved(b, 3, 0, 0))), 0);
    const Moving_soup other(b, moved(b, 3, 0, 0));
    EXPECT_EQ(first_impact(still(a).surface(), other.surface())->faces, true_pairs(a, b).front());
  }
}

/// Faces that land at the same time are told by gaps between their boxes, or one by one.
TEST(Impact_search, of_sheets_that_land_flat_is_exact_and_of_the_lowest_pair) {
  const Face_soup sheet(cloth(5, 6));
  const auto tilted = [](Face_soup soup) {
    deform(soup, [](const Point& p) { return Point(p.x(), p.y(), p.z() + 0.25 * p.x()); });
    return soup;
  };
  const auto along_x = [](Face_soup soup) {
    deform(soup, [](const Point& p) { return Point(p.z(), p.x(), p.y()); });
    return soup;
  };
  const auto land = [&](const Face_soup& floor, const Face_soup& block, double from, double to, auto place) {
    return expect_impact(still(place(floor)),
                         Moving_soup(place(moved(block, 0.03, 0.07, from)), place(moved(block, 0.03, 0.07, to))));
  };
  const auto as_it_is = [](const Face_soup& soup) { return soup; };
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const Face_soup floor = shuffled(sheet, seed), block = shuffled(sheet, seed + 10);
    for (const auto& [from, to, time] : {std::tuple(1.0, -1.0, 0.5), std::tuple(1.0, -2.0, 1.0 / 3),
                                         std::tuple(-1.0, 2.0, 1.0 / 3), std::tuple(1.0, 0.0, 1.0)}) {
      SCOPED_TRACE(testing::Message() << seed << ' ' << from << ' ' << to);
      EXPECT_EQ(land(floor, block, from, to, as_it_is), time);
      EXPECT_EQ(land(floor, block, from, to, along_x), time);
      EXPECT_NEAR(land(floor, block, from, to, tilted), time, 1e-15);
      for (const double factor : {0x1p-1020, 0x1p1020})
        EXPECT_EQ(land(floor, block, from, to, [factor](const Face_soup& soup) { return placed(soup, factor); }), time);
    }
    // The gaps between these differ, but doubles cannot tell.
    Face_soup uneven = crumpled(floor, 0x1p-60, seed);
    deform(uneven, [](const Point& p) { return Point(p.x(), p.y(), std::max(p.z() - 0x1.8p-61, 0.0)); });
    EXPECT_NEAR(land(uneven, block, 1, -1, as_it_is), 0.5, 1e-15);
    EXPECT_NEAR(land(floor, crumpled(block, 0x1p-53, seed), 1, -1, as_it_is), 0.5, 1e-15);
    // The gap between these is infinite in double.
    const auto huge = [](const Face_soup& soup, double z) { return placed(moved(soup, 0, 0, z), 0x1p1023); };
    EXPECT_EQ(expect_impact(Moving_soup(huge(floor, -1), huge(floor, 1)), Moving_soup(huge(block, 1), huge(block, -1))),
              0.5);
    EXPECT_NEAR(land(floor, block, 0.31, -0.2, as_it_is), 0.31 / 0.51, 1e-15);
    EXPECT_NEAR(land(moved(floor, 0, 0, 0.1), block, 0.4, -0.2, as_it_is), 0.5, 1e-15);
    EXPECT_NEAR(land(floor, crumpled(block, 0.01, seed), 0.31, -0.2, as_it_is), 0.31 / 0.51, 0.05);
  }
}

TEST(Impact_search, finds_what_has_passed_through_by_the_end) {
  const Face_soup sheet(cloth(9, 9)), ball = placed(icosphere(2), 0.1);
  const Moving_soup fall(moved(ball, 0.1, 0.07, 2), moved(ball, 0.1, 0.07, -2));
  ASSERT_TRUE(true_pairs(sheet, fall.start).empty());
  ASSERT_TRUE(true_pairs(sheet, fall.end).empty());
  EXPECT_NEAR(expect_impact(still(sheet), fall), 0.475, 0.005);
  EXPECT_EQ(expect_impact(still(sheet), Moving_soup(moved(ball, 5, 0, 2), moved(ball, 5, 0, -2))), infinity);
  EXPECT_EQ(expect_impact(shifted(sheet, 0, 0, -4), Moving_soup(moved(ball, 0, 0, 2), moved(ball, 0, 0, -2))),
            infinity);
}

TEST(Impact_search, of_nested_spheres_is_when_the_inner_one_has_grown) {
  const Face_soup ball(icosphere(2));
  EXPECT_EQ(expect_impact(still(ball), Moving_soup(placed(ball, 0.5), placed(ball, 2))), 1.0 / 3);
  EXPECT_EQ(expect_impact(still(ball), Moving_soup(placed(ball, 0.5), placed(ball, 0.75))), infinity);
}

TEST(Impact_search, is_the_same_for_other_units_and_far_from_the_origin) {
  std::mt19937_64 random(3);
  const Face_soup ball(icosphere(2));
  int meet = 0;
  for (const auto& object : moving_objects()) {
    const Face_soup start = moved(posed_at_random(object, 1, random), 4, 0, 0), end = moved(start, -6, 0.25, 0);
    const double time = expect_impact(still(ball), Moving_soup(start, end));
    if (time < infinity) ++meet;
    for (const double factor : {0x1p-600, 0x1p-200, 0x1p200, 0x1p900})
      EXPECT_EQ(expect_impact(still(placed(ball, factor)), Moving_soup(placed(start, factor), placed(end, factor))),
                time);
    expect_impact(still(placed(ball, 1, 0x1p30)), Moving_soup(placed(start, 1, 0x1p30), placed(end, 1, 0x1p30)));
  }
  EXPECT_GT(meet, 4);
}

TEST(Impact_search, of_larger_meshes_equals_exhaustive_checking) {
  const Face_soup ring(torus_knot({.p = 1, .q = 0, .segments = 24, .sides = 9}));
  const auto fall = [](double radius, double x) {
    const Face_soup ball = placed(icosphere(6), radius);
    return Moving_soup(moved(ball, 0, 0, 3), moved(ball, x, 0, -3));
  };
  EXPECT_EQ(expect_impact(still(ring), fall(0.25, 0)), infinity) << "through the hole";
  EXPECT_LT(expect_impact(still(ring), fall(0.25, 3)), 1);
  EXPECT_LT(expect_impact(still(ring), fall(1.4, 0)), 1);
  std::mt19937_64 random(4);
  const Face_soup turned = posed_at_random(ring, 0, random);
  EXPECT_LT(expect_impact(shifted(ring, 1, 0, 0), Moving_soup(moved(turned, 4, 0, 0.5), moved(turned, -3, 0, 0.5))), 1);
}

}  // namespace
}  // namespace lodestone
