// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include "lodestone/io/motion/deformed_points.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/errors.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

using Vector = Kernel::Vector_3;
using Points = std::vector<Point>;
using std::numbers::pi;

/// Corners and middle of a 4 x 2 x 6 box around (10, 0, 0).
const Points box = [] {
  Points points{Point(10, 0, 0)};
  for (const double x : {8.0, 12.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-3.0, 3.0}) points.emplace_back(x, y, z);
  return points;
}();
const Point middle(10, 0, 0);

Points posed(const Motion& motion, std::size_t frame, std::size_t vertices = box.size()) {
  Points positions(vertices);
  motion.pose(frame, positions);
  return positions;
}

Points posed(std::vector<Deformation> deformations, std::size_t frame, const Points& rest = box) {
  return posed(deform(rest, std::move(deformations)), frame, rest.size());
}

double distance(const Point& p, const Point& q) { return std::sqrt(CGAL::squared_distance(p, q)); }

void expect_near(const Points& actual, const Points& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_LT(distance(actual[i], expected[i]), 1e-12) << "point " << i;
}

Points moved(const Points& points, const Vector& by) {
  Points result;
  for (const Point& p : points) result.push_back(p + by);
  return result;
}

Points scaled(const Points& points, double factor) {
  Points result;
  for (const Point& p : points) result.push_back(middle + factor * (p - middle));
  return result;
}

TEST(Deform, without_deformations_never_moves) {
  EXPECT_EQ(posed(std::vector<Deformation>{}, 0), box);
  EXPECT_EQ(posed(std::vector<Deformation>{}, 1'000'000), box);
}

TEST(Deform, accepts_an_empty_shape) { EXPECT_TRUE(posed({Wobble{}, Bend{}, Twist{}, Spin{}}, 3, {}).empty()); }

TEST(Deform, accepts_a_shape_without_extent) {
  const Points point(2, Point(1, 2, 3));
  expect_near(posed({Wobble{}, Bend{}, Twist{}, Spin{}, Inflate{}}, 7, point), point);
}

TEST(Deform, refuses_a_wrong_number_of_positions) {
  const Motion motion = deform(box, {Wobble{}});
  Points positions(box.size() - 1);
  EXPECT_THROW(motion.pose(0, positions), Bad_motion);
}

TEST(Deform, gives_the_same_bytes_for_the_same_frame_in_any_order_of_calls) {
  const std::vector<Deformation> all{
      Wobble{},  Bend{}, Twist{},
      Inflate{}, Spin{}, Travel{{{0, {0, 0, 0}}, {50, {1, 2, 3}}, {90, {0, 1, 0}}}, Path::smooth}};
  const Motion motion = deform(box, all);
  const Points first = posed(motion, 37);
  posed(motion, 5);
  const Points second = posed(motion, 37);
  const Points other = posed(deform(box, all), 37);
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(Point)), 0);
  EXPECT_EQ(std::memcmp(first.data(), other.data(), first.size() * sizeof(Point)), 0);
  EXPECT_NE(posed(motion, 38), first);
}

TEST(Deform, applies_deformations_in_their_order) {
  const Deformation spin = Spin{.axis = {0, 0, 1}, .degrees_per_frame = 90};
  const Deformation travel = Travel{{{0, {5, 0, 0}}}, Path::linear};
  // A quarter turn about (10, 0, 0): a translation along +x becomes one along +y if it came before the turn.
  EXPECT_LT(distance(posed({spin, travel}, 1)[0], Point(15, 0, 0)), 1e-12);
  EXPECT_LT(distance(posed({travel, spin}, 1)[0], Point(10, 5, 0)), 1e-12);
}

TEST(Wobble, follows_its_formula) {
  const Wobble wobble{.amplitude = 0.1, .waves = 2, .period = 20, .phase = 0.125};
  const double s = std::sqrt(16 + 4 + 36) / 2;
  const double k = 2 * pi / s;
  const double a = 2 * pi * (7.0 / 20 + 0.125);
  Points expected;
  for (const Point& p : box) {
    const Vector d = p - middle;
    expected.push_back(p + 0.1 * s *
                               Vector(std::sin(k * d.y() + a), std::sin(k * d.z() + a + 2 * pi / 3),
                                      std::sin(k * d.x() + a + 4 * pi / 3)));
  }
  expect_near(posed({wobble}, 7), expected);
}

TEST(Wobble, repeats_after_its_period_and_travels_in_between) {
  const Wobble wobble{.amplitude = 0.1, .waves = 1, .period = 20};
  expect_near(posed({wobble}, 23), posed({wobble}, 3));
  EXPECT_GT(distance(posed({wobble}, 13)[1], posed({wobble}, 3)[1]), 0.1);
}

TEST(Wobble, is_translation_invariant_and_scales_with_the_shape) {
  const Vector far(100, -50, 30);
  const Points rest = moved(scaled(box, 3), far);
  const Points expected = moved(scaled(posed({Wobble{}}, 11), 3), far);
  const Points actual = posed({Wobble{}}, 11, rest);
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_LT(distance(actual[i], expected[i]), 1e-10);
}

TEST(Wobble, of_period_zero_does_not_travel) {
  const Wobble wobble{.period = 0, .phase = 0.3};
  EXPECT_EQ(posed({wobble}, 0), posed({wobble}, 99));
}

TEST(Bend, by_half_a_turn_makes_a_straight_line_a_half_circle) {
  Points line;
  for (int i = -10; i <= 10; ++i) line.emplace_back(i, 0, 0);
  const Points arc = posed({Bend{.axis = {2, 0, 0}, .towards = {1, 0, 1}, .degrees = 180, .period = 0}}, 0, line);
  // An arc of length 20 over half a turn has radius 20 / pi; the middle stays, the ends rise towards +z.
  const double radius = 20 / pi;
  for (const Point& p : arc) EXPECT_NEAR(distance(p, Point(0, 0, radius)), radius, 1e-12);
  EXPECT_LT(distance(arc[10], Point(0, 0, 0)), 1e-12);
  EXPECT_LT(distance(arc[0], Point(-radius, 0, radius)), 1e-12);
  EXPECT_LT(distance(arc[20], Point(radius, 0, radius)), 1e-12);
}

TEST(Bend, keeps_the_distance_from_the_middle_line) {
  Points strip;
  for (int i = -10; i <= 10; ++i) strip.emplace_back(i, 0, 1);
  strip.emplace_back(0, 0, -1);
  const Points arc = posed({Bend{.axis = {1, 0, 0}, .towards = {0, 0, 1}, .degrees = 90, .period = 0}}, 0, strip);
  const double radius = 20 / (pi / 2);
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(distance(arc[i], Point(0, 0, radius)), radius - 1, 1e-12);
}

TEST(Bend, swings_through_the_rest_shape_to_the_other_side) {
  const Bend bend{.axis = {1, 0, 0}, .towards = {0, 0, 1}, .degrees = 40, .period = 40};
  expect_near(posed({bend}, 0), box);
  expect_near(posed({bend}, 20), box);
  const Points line{Point(-1, 0, 0), Point(0, 0, 0), Point(1, 0, 0)};
  EXPECT_GT(posed({bend}, 10, line)[0].z(), 0.1);
  EXPECT_LT(posed({bend}, 30, line)[0].z(), -0.1);
}

TEST(Twist, keeps_the_distance_from_the_axis_and_the_position_along_it) {
  const Points twisted = posed({Twist{.axis = {0, 0, 2}, .degrees = 70, .period = 0}}, 0);
  for (std::size_t i = 0; i < box.size(); ++i) {
    EXPECT_NEAR(twisted[i].z(), box[i].z(), 1e-12);
    EXPECT_NEAR(std::hypot(twisted[i].x() - 10, twisted[i].y()), std::hypot(box[i].x() - 10, box[i].y()), 1e-12);
  }
}

TEST(Twist, turns_the_ends_by_half_the_angle_each) {
  const Points line{Point(1, 0, -2), Point(1, 0, 0), Point(1, 0, 2), Point(-1, 0, 0)};
  const Points twisted = posed({Twist{.axis = {0, 0, 1}, .degrees = 180, .period = 8}}, 2, line);
  expect_near(twisted, {Point(0, -1, -2), Point(1, 0, 0), Point(0, 1, 2), Point(-1, 0, 0)});
}

TEST(Inflate, scales_from_one_to_its_factor_and_stays_there) {
  const Inflate inflate{.factor = 3, .frames = 100};
  expect_near(posed({inflate}, 0), box);
  expect_near(posed({inflate}, 50), scaled(box, 2));
  expect_near(posed({inflate}, 100), scaled(box, 3));
  expect_near(posed({inflate}, 5000), scaled(box, 3));
}

TEST(Spin, turns_about_the_middle) {
  const Points turned = posed({Spin{.axis = {0, 0, 3}, .degrees_per_frame = 30}}, 3);
  for (std::size_t i = 0; i < box.size(); ++i) {
    const Vector d = box[i] - middle;
    EXPECT_LT(distance(turned[i], middle + Vector(-d.y(), d.x(), d.z())), 1e-12);
  }
}

class Paths : public testing::TestWithParam<Path> {};

TEST_P(Paths, pass_through_their_way_points) {
  const Travel travel{{{10, {1, 0, 0}}, {25, {2, 5, 1}}, {45, {-3, 1, 0}}, {70, {1, 0, 0}}}, GetParam()};
  for (const Way_point& p : travel.way_points) expect_near(posed({travel}, std::size_t(p.frame)), moved(box, p.at));
}

INSTANTIATE_TEST_SUITE_P(Deformation, Paths, testing::Values(Path::linear, Path::smooth, Path::closed));

TEST(Travel, on_a_linear_path_is_half_way_at_half_time) {
  const Travel travel{{{10, {1, 0, 0}}, {30, {3, 4, 0}}}, Path::linear};
  expect_near(posed({travel}, 20), moved(box, {2, 2, 0}));
}

TEST(Travel, rests_before_the_first_and_after_the_last_way_point) {
  for (const Path path : {Path::linear, Path::smooth}) {
    const Travel travel{{{10, {1, 0, 0}}, {30, {3, 4, 0}}}, path};
    expect_near(posed({travel}, 0), moved(box, {1, 0, 0}));
    expect_near(posed({travel}, 31), moved(box, {3, 4, 0}));
  }
}

TEST(Travel, on_a_smooth_path_reproduces_a_straight_line_at_constant_speed) {
  const Travel travel{{{0, {0, 0, 0}}, {10, {1, 2, 0}}, {40, {4, 8, 0}}, {50, {5, 10, 0}}}, Path::smooth};
  for (std::size_t frame = 0; frame <= 50; ++frame)
    expect_near(posed({travel}, frame), moved(box, {double(frame) / 10, double(frame) / 5, 0}));
}

TEST(Travel, on_a_curved_path_has_the_mean_velocity_between_the_neighbours_of_a_way_point) {
  const std::vector<Way_point> way{
      {0, {0, 0, 0}}, {1000, {3000, 0, 0}}, {3000, {0, 8000, 0}}, {7000, {0, 0, 4000}}, {9000, {0, 0, 0}}};
  const auto velocity_at = [&](Path path, std::size_t frame) {
    const Motion motion = deform(box, {Travel{way, path}});
    return posed(motion, frame + 1)[0] - posed(motion, frame)[0];
  };
  const auto mean = [&](std::size_t from, std::size_t to) {
    return (way[to].at - way[from].at) / (way[to].frame - way[from].frame);
  };
  for (const Path path : {Path::smooth, Path::closed})
    for (const std::size_t i : {1, 2, 3})
      EXPECT_LT(std::sqrt((velocity_at(path, std::size_t(way[i].frame)) - mean(i - 1, i + 1)).squared_length()), 0.03)
          << i;
  // At its ends a path that is not closed has but one neighbour.
  EXPECT_LT(std::sqrt((velocity_at(Path::smooth, 0) - mean(0, 1)).squared_length()), 0.03);
  EXPECT_LT(std::sqrt((velocity_at(Path::smooth, 8999) - mean(3, 4)).squared_length()), 0.03);
}

TEST(Travel, on_a_smooth_path_has_no_kink_where_a_linear_one_has) {
  const std::vector<Way_point> corner{{0, {0, 0, 0}}, {1000, {1000, 0, 0}}, {2000, {1000, 1000, 0}}};
  const auto kink = [&](Path path) {
    const Motion motion = deform(box, {Travel{corner, path}});
    const Point before = posed(motion, 999)[0];
    const Point there = posed(motion, 1000)[0];
    const Point after = posed(motion, 1001)[0];
    return std::sqrt(((after - there) - (there - before)).squared_length());
  };
  EXPECT_NEAR(kink(Path::linear), std::sqrt(2.0), 1e-9);
  EXPECT_LT(kink(Path::smooth), 0.01);
}

TEST(Travel, on_a_closed_path_repeats_for_ever_without_a_kink_at_its_seam) {
  const Travel travel{{{100, {0, 0, 0}}, {400, {300, 0, 0}}, {800, {0, 400, 0}}, {1100, {0, 0, 0}}}, Path::closed};
  const Motion motion = deform(box, {travel});
  for (const std::size_t frame : {100, 333, 850}) {
    expect_near(posed(motion, frame + 1000), posed(motion, frame));
    expect_near(posed(motion, frame + 7000), posed(motion, frame));
  }
  // Also before the first way point: frame 50 is the path's frame 1050.
  expect_near(posed(motion, 50), posed(motion, 1050));
  const Vector into = posed(motion, 1100)[0] - posed(motion, 1099)[0];
  const Vector out_of = posed(motion, 1101)[0] - posed(motion, 1100)[0];
  EXPECT_LT(std::sqrt((into - out_of).squared_length()), 0.05 * std::sqrt(into.squared_length()));
}

// ---- Fields outside their range ----

std::string message_of(const Deformation& deformation) {
  try {
    deform(box, {deformation});
  } catch (const Bad_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Deformation, refuses_numbers_that_are_not_finite) {
  EXPECT_EQ(message_of(Wobble{.amplitude = infinity}), "amplitude is inf, must be finite");
  EXPECT_EQ(message_of(Wobble{.waves = std::nan("")}), "waves is nan, must be finite");
  EXPECT_EQ(message_of(Wobble{.phase = -infinity}), "phase is -inf, must be finite");
  EXPECT_EQ(message_of(Bend{.degrees = infinity}), "degrees is inf, must be finite");
  EXPECT_EQ(message_of(Bend{.phase = infinity}), "phase is inf, must be finite");
  EXPECT_EQ(message_of(Twist{.degrees = infinity}), "degrees is inf, must be finite");
  EXPECT_EQ(message_of(Twist{.phase = infinity}), "phase is inf, must be finite");
  EXPECT_EQ(message_of(Spin{.degrees_per_frame = infinity}), "degrees_per_frame is inf, must be finite");
}

TEST(Deformation, refuses_periods_below_zero) {
  EXPECT_EQ(message_of(Wobble{.period = -1}), "period is -1, must be >= 0 and finite");
  EXPECT_EQ(message_of(Bend{.period = -1}), "period is -1, must be >= 0 and finite");
  EXPECT_EQ(message_of(Twist{.period = infinity}), "period is inf, must be >= 0 and finite");
}

TEST(Deformation, refuses_zero_and_non_finite_directions) {
  EXPECT_EQ(message_of(Bend{.axis = {0, 0, 0}}), "axis must be finite and not zero");
  EXPECT_EQ(message_of(Bend{.towards = {0, 0, 0}}), "towards must be finite and not zero");
  EXPECT_EQ(message_of(Twist{.axis = {0, 0, 0}}), "axis must be finite and not zero");
  EXPECT_EQ(message_of(Spin{.axis = {1, infinity, 0}}), "axis must be finite and not zero");
  EXPECT_EQ(message_of(Bend{.axis = {1, 0, 1}, .towards = {-2, 0, -2}}), "towards is parallel to axis");
}

TEST(Deformation, accepts_directions_of_any_length) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  expect_near(posed({Spin{.axis = {0, 0, 1e300}}}, 9), posed({Spin{}}, 9));
  expect_near(posed({Twist{.axis = {0, 0, tiny}}}, 9), posed({Twist{}}, 9));
  expect_near(posed({Bend{.axis = {1e300, 0, 0}, .towards = {1e300, 0, 1e300}}}, 9), posed({Bend{}}, 9));
}

TEST(Inflate, refuses_a_factor_or_a_duration_that_is_not_positive) {
  EXPECT_EQ(message_of(Inflate{.factor = 0}), "factor is 0, must be > 0 and finite");
  EXPECT_EQ(message_of(Inflate{.frames = -5}), "frames is -5, must be > 0 and finite");
}

TEST(Travel, refuses_way_points_that_make_no_path) {
  EXPECT_EQ(message_of(Travel{}), "way_points is empty");
  EXPECT_EQ(message_of(Travel{{{5, {0, 0, 0}}, {5, {1, 0, 0}}}, Path::linear}),
            "way point 1 is not after the one before");
  EXPECT_EQ(message_of(Travel{{{0, {0, infinity, 0}}}, Path::linear}),
            "coordinate of a way point is inf, must be finite");
  EXPECT_EQ(message_of(Travel{{{infinity, {0, 0, 0}}}, Path::linear}), "frame of a way point is inf, must be finite");
  EXPECT_EQ(message_of(Travel{{{0, {0, 0, 0}}, {5, {0, 0, 0}}}, Path::closed}), "a closed path needs three way points");
  EXPECT_EQ(message_of(Travel{{{0, {0, 0, 0}}, {5, {1, 0, 0}}, {9, {2, 0, 0}}}, Path::closed}),
            "a closed path must end where it starts");
}

TEST(Deformed_points, are_those_of_the_motion_bit_by_bit) {
  static_assert(Computed_points<Deformed_points>);
  const std::vector<Deformation> deformations{
      Wobble{}, Bend{}, Twist{}, Inflate{}, Spin{}, Travel{.way_points = {{0, {0, 0, 0}}, {9, {1, 2, 3}}}}};
  const auto motion = deform(box, deformations);
  Deformed_points points(box, deformations);
  const std::vector<std::uint32_t> list{7, 2};
  for (const std::size_t frame : {0U, 3U, 8U, 200U, 1U}) {
    const auto before = points.pose_number();
    points.set_frame(static_cast<double>(frame));
    EXPECT_GT(points.pose_number(), before);
    const auto expected = posed(motion, frame);
    std::vector<double> all(3 * box.size()), listed(3 * box.size(), -1);
    points.pose_all(all);
    points.pose(list, listed);
    for (std::uint32_t v = 0; v < box.size(); ++v) {
      const Eigen::Vector3d single = points(v);
      EXPECT_EQ(Point(single.x(), single.y(), single.z()), expected[v]);
      EXPECT_EQ(Point(all[3 * v], all[3 * v + 1], all[3 * v + 2]), expected[v]);
      const Point in_list(listed[3 * v], listed[3 * v + 1], listed[3 * v + 2]);
      EXPECT_EQ(in_list, v == 7 || v == 2 ? expected[v] : Point(-1, -1, -1));
    }
  }
}

TEST(Deformed_points, refuse_what_is_no_frame) {
  Deformed_points points(box, {Wobble{}});
  const auto before = points.pose_number();
  EXPECT_THROW(points.set_frame(-1), Bad_argument);
  EXPECT_THROW(points.set_frame(std::numeric_limits<double>::infinity()), Bad_argument);
  EXPECT_EQ(points.pose_number(), before);
  EXPECT_THROW(Deformed_points(box, {Inflate{.factor = 0}}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
