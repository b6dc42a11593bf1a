// SPDX-License-Identifier: GPL-3.0-or-later
// Computed points that promise something about themselves, in mode certified; and promises at their limits.
#include <functional>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "detection/certified_scene.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/io/motion/deformed_points.h"

namespace lodestone {
namespace {

/// Points that somebody writes, with a promise about them.
template <class Promise>
struct Promised_points {
  std::vector<double> now;
  Promise promise{};
  std::uint64_t number = 1;

  explicit Promised_points(const Surface_mesh& mesh) : now(Face_soup(mesh).coordinates) {}

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(now.size() / 3); }
  std::uint64_t pose_number() const { return number; }
  Eigen::Vector3d operator()(std::uint32_t v) const { return Eigen::Vector3d(now.data() + 3 * std::size_t{v}); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> to) const {
    for (const auto v : vertices) Eigen::Map<Eigen::Vector3d>(to.data() + 3 * std::size_t{v}) = (*this)(v);
  }
  void pose_all(std::span<double> to) const { std::ranges::copy(now, to.begin()); }
  auto bound(const Bounded_object& object) const { return promise.bound(object); }

  void shift(double x, double y) {
    for (std::size_t i = 0; i < now.size(); i += 3) now[i] += x, now[i + 1] += y;
    ++number;
  }
};

/// Where nothing else is.
template <class Promise>
Positions far_from(const Promised_points<Promise>& points) {
  Positions far = Eigen::Map<const Positions>(points.now.data(), points.vertex_count(), 3);
  far.col(1).array() += 100;
  return far;
}

template <class Promise>
class Own_promise : public testing::Test {};
using Promises = testing::Types<Displacement_promise, Lipschitz_promise, Stretch_promise>;
TYPED_TEST_SUITE(Own_promise, Promises);

/// The object moves as a whole, which keeps all of these promises.
TYPED_TEST(Own_promise, has_the_answers_of_mode_exact_wherever_the_object_is_placed) {
  for (const bool placed : {false, true}) {
    const Surface_mesh a = potato(12, 1), b = potato(12, 2);
    Promised_points<TypeParam> points(a);
    Detector certified({.mode = Mode::certified}), exact({.mode = Mode::exact});
    for (Detector<>* detector : {&certified, &exact}) {
      detector->add(a, point_map(a, points));
      detector->add(b);
    }
    Eigen::Isometry3d placement(Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.6, 0, 0.8)));
    placement.translation() = Eigen::Vector3d(4, 0.1, 0);
    std::size_t colliding = 0;
    for (int frame = 0; frame < 40; ++frame) {
      if (placed)
        for (Detector<>* detector : {&certified, &exact}) detector->place(0, placement);
      const Frame& found = certified.detect();
      expect_same_answers(found, exact.detect(), 2);
      EXPECT_EQ(found.statistics.violations, 0U);
      colliding += found.collides() ? 1 : 0;
      const double step = (frame / 10) % 2 == 0 ? -0.25 : 0.25;
      points.shift(placed ? step : frame < 20 ? 0.25 : -0.25, 0.01);
      if constexpr (std::is_same_v<TypeParam, Displacement_promise>) points.promise.move(0.2503);
    }
    EXPECT_GT(colliding, 3U);
    EXPECT_LT(colliding, 37U);
  }
}

TEST(Own_stretch, is_watched_wherever_the_object_is_placed) {
  for (const bool placed : {false, true}) {
    const Surface_mesh a = potato(12, 1), b = potato(12, 2);
    Promised_points<Stretch_promise> points(a);
    Detector detector({.mode = Mode::certified});
    detector.add(a, point_map(a, points));
    detector.add(b);
    if (placed) detector.place(0, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0, 0)));
    detector.detect();
    points.shift(0, 0);
    EXPECT_EQ(detector.detect().statistics.violations, 0U);
    for (std::size_t i = 0; i < points.now.size(); i += 3) points.now[i] *= 1.5;
    ++points.number;
    EXPECT_GT(detector.detect().statistics.violations, 0U);
  }
}

TEST(Own_lipschitz, is_about_the_first_query_whichever_objects_it_is_about) {
  const Surface_mesh a = potato(12, 1);
  Surface_mesh b = potato(12, 2), c = potato(6, 3);
  shift(b, 50), shift(c, 90);
  Promised_points<Lipschitz_promise> points(a);
  const auto scale = [&points](double factor) {
    for (double& coordinate : points.now) coordinate *= factor;
    ++points.number;
  };
  Detector detector({.mode = Mode::certified});
  detector.add(a, point_map(a, points));
  for (const auto* mesh : {&b, &c}) detector.add(*mesh);
  detector.detect(1, 2);
  scale(0.5), points.promise.set_constant(0.5, 1e-9);
  EXPECT_EQ(detector.detect().statistics.violations, 0U);
  scale(2), points.promise.set_constant(1, 1e-9);  // as at rest
  shift(b, -50);
  const Frame& found = detector.detect();
  EXPECT_TRUE(found.collides());
  EXPECT_EQ(found.statistics.violations, 0U);
}

TEST(Own_displacement, is_tight_again_where_leaves_are_read) {
  const Surface_mesh a = icosphere(40), b = icosphere(40);  // of radius 1
  Promised_points<Displacement_promise> points(a);
  Detector detector({.mode = Mode::certified});
  detector.add(a, point_map(a, points));
  detector.add(b);
  points.shift(1.99, 0);  // they touch at a small part
  points.promise.move(1.9901);
  std::size_t posed = 0;
  for (int frame = 0; frame < 100; ++frame) {
    points.shift(frame % 2 == 0 ? 0.01 : -0.01, 0);
    points.promise.move(0.01001);
    posed = detector.detect().statistics.leaves_posed;
  }
  EXPECT_GT(posed, 0U);
  EXPECT_LT(posed, detector.bounded(0)->layout().leaf_count() / 3);
}

TEST(Displacement, whose_sum_overflows_promises_nothing) {
  Surface_mesh a = potato(8, 1), b = potato(8, 2);
  shift(b, 9);
  Displacement_promise promise;
  Detector detector({.mode = Mode::certified});
  detector.add(std::as_const(a));
  detector.add(std::as_const(b));
  detector.promise(1, promise);
  EXPECT_FALSE(detector.detect().collides());
  for (int i = 0; i < 2; ++i) {
    promise.move(1e308);
    EXPECT_FALSE(detector.detect().collides());
  }
  shift(b, -9);
  promise.move(9);
  EXPECT_TRUE(detector.detect().collides());
}

TEST(Skinned_points, that_are_assigned_are_in_a_new_pose) {
  Surface_mesh a = long_body(9, 1), b = potato(6, 2);
  shift(b, 0, 4);
  Skinned_points points = limb(a), other = points;
  Detector certified({.mode = Mode::certified}), exact({.mode = Mode::exact});
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(a, point_map(a, points));
    detector->add(b);
  }
  bend(points, 0, {0, 0, 0});
  bend(other, 0, {0, 3.5, 0});
  EXPECT_FALSE(certified.detect().collides());
  points = other;
  EXPECT_TRUE(exact.detect().collides());
  EXPECT_TRUE(certified.detect().collides());
}

/// Points of one mesh in the modes certified and exact, beside a body at (0, 0, 4).
template <class Points>
class Assigned_points {
 public:
  explicit Assigned_points(Points points) : points_(std::move(points)) {
    shift(b_, 0, 0, 4);
    for (Detector<>* detector : {&certified_, &exact_}) {
      detector->add(a_, point_map(a_, points_));
      detector->add(b_);
    }
  }
  Assigned_points(const Assigned_points&) = delete;

  static Surface_mesh mesh() { return long_body(9, 1); }
  Points& points() { return points_; }
  Detector<>& certified() { return certified_; }
  /// Asks both modes.
  void expect_collision(bool collides) {
    EXPECT_EQ(exact_.detect().collides(), collides);
    const Frame& frame = certified_.detect();
    EXPECT_EQ(frame.collides(), collides);
    EXPECT_EQ(frame.face_pairs, exact_.detect().face_pairs);
    EXPECT_EQ(frame.statistics.violations, 0U);
    EXPECT_NE(certified_.bounded(0), nullptr);
  }

 private:
  Surface_mesh a_ = mesh(), b_ = potato(6, 2);
  Points points_;
  Detector<> certified_{{.mode = Mode::certified}}, exact_{{.mode = Mode::exact}};
};

/// Each coordinate of the mesh, multiplied.
std::vector<double> scaled_rest(double factor) {
  auto rest = Face_soup(long_body(9, 1)).coordinates;
  for (double& x : rest) x *= factor;
  return rest;
}

TEST(Deformed_points, that_are_assigned_have_bounds_of_their_own) {
  const auto points_of = [](double factor) {
    const Surface_mesh mesh = long_body(9, 1);
    return Deformed_points({mesh.points().begin(), mesh.points().end()}, {Inflate{.factor = factor, .frames = 1}});
  };
  for (const bool held : {false, true}) {
    Assigned_points body(points_of(1.01));
    body.points().set_frame(1);
    body.expect_collision(false);
    std::optional<Held_positions> hold;
    if (held) hold.emplace(body.certified().hold_positions());
    body.expect_collision(false);
    for (const double factor : {6.0, 1.02, 7.0}) {
      body.points() = points_of(factor);
      body.expect_collision(false);
      body.points().set_frame(1);
      if (held) body.certified().update(0);
      body.expect_collision(factor > 2);
    }
  }
}

TEST(Morphed_points, that_are_assigned_have_bounds_of_their_own) {
  const auto points_of = [](double rest_factor, std::size_t targets, double offset_factor) {
    Morph_target target;
    target.offsets = scaled_rest(offset_factor);
    Morphed_points points(scaled_rest(rest_factor), std::vector(targets, target));
    points.set_weights(std::vector<double>(targets, 1.0));
    return points;
  };
  Assigned_points body(points_of(1, 3, 0.01));
  body.expect_collision(false);
  body.points() = points_of(1, 1, 0.02);  // fewer targets
  body.expect_collision(false);
  body.points() = points_of(1, 1, 5);  // longer offsets
  body.expect_collision(true);
  body.points() = points_of(1, 0, 0);
  body.expect_collision(false);
  body.points() = points_of(6, 2, 0.01);  // larger at rest
  body.expect_collision(true);
}

TEST(Skinned_points, that_are_assigned_have_bounds_of_their_own) {
  const auto points_of = [](double rest_factor, std::size_t joints, std::uint32_t joint) {
    const auto rest = scaled_rest(rest_factor);
    const std::vector<std::uint32_t> all(rest.size() / 3, joint);
    Skinned_points points(rest, Joint_influences::of(1, all, std::vector<double>(all.size(), 1.0)), joints);
    std::vector<Eigen::Affine3d> motions(joints, Eigen::Affine3d::Identity());
    motions.back() = Eigen::Translation3d(0, 0, 3.5);
    points.set_joints(motions);
    return points;
  };
  Assigned_points body(points_of(1, 5, 3));
  body.expect_collision(false);
  body.points() = points_of(1, 2, 0);  // fewer joints
  body.expect_collision(false);
  body.points() = points_of(1, 2, 1);  // the other joint
  body.expect_collision(true);
  body.points() = points_of(1, 3, 0);
  body.expect_collision(false);
  body.points() = points_of(6, 3, 0);  // larger at rest
  body.expect_collision(true);
}

/// A body that grows though its promise says that it does not.
template <class Promise>
void expect_error_of_queries_that_read_everything(const Promise& promise) {
  Surface_mesh a = potato(10, 1), b = potato(10, 2);
  const auto expect_broken = [&](const auto& ask) {
    Surface_mesh body = b;
    Detector detector({.mode = Mode::certified, .exact = {.throw_if_broken = true}});
    detector.add(std::as_const(a));
    detector.add(std::as_const(body));
    detector.promise(1, promise);
    detector.detect();
    deform(body, [](const Point& p) { return Point(2.5 * p.x(), p.y(), p.z()); });
    EXPECT_THROW(ask(detector), Broken_bound);
  };
  const auto positions = [](const Surface_mesh& mesh) -> Positions {
    const auto coordinates = Face_soup(mesh).coordinates;
    return Eigen::Map<const Positions>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3);
  };
  const Positions end_of_a = positions(a), end = positions(b);
  expect_broken([](Detector<>& detector) { detector.parting(0, 1); });
  expect_broken([](Detector<>& detector) { detector.ray_tree(1); });
  expect_broken([](Detector<>& detector) { detector.save(1); });
  expect_broken([](Detector<>& detector) { detector.detect(1, 1); });
  expect_broken([](Detector<>& detector) {
    detector.first_hits(1, std::vector(1000, Ray{.origin = {9, 0, 0}, .direction = {1, 0, 0}}));
  });
  expect_broken([&](Detector<>& detector) { detector.first_self_impact(1, end); });
  expect_broken([&](Detector<>& detector) { detector.first_impact(0, end_of_a, 1, end); });
}

TEST(Broken_promise, is_an_error_of_queries_that_read_everything_too) {
  expect_error_of_queries_that_read_everything(Stretch_promise());
  expect_error_of_queries_that_read_everything(Displacement_promise());
  expect_error_of_queries_that_read_everything(Lipschitz_promise());
  expect_error_of_queries_that_read_everything(Box_promise([](Region_index, const Aabb& rest) { return rest; }));
}

TEST(Own_displacement, knows_nothing_of_given_positions) {
  const Surface_mesh a = icosphere(12);
  Surface_mesh b = icosphere(12);
  shift(b, 5);
  Promised_points<Displacement_promise> points(a);
  Detector detector({.mode = Mode::certified});
  detector.add(a, point_map(a, points));
  detector.add(std::as_const(b));
  EXPECT_FALSE(detector.detect().collides());
  points.shift(3.5, 0);
  points.promise.move(3.501);
  EXPECT_TRUE(detector.detect().collides());
  detector.update(0, far_from(points));
  EXPECT_FALSE(detector.detect().collides());
  detector.update(0);
  EXPECT_TRUE(detector.detect().collides());
  points.shift(0.01, 0);
  points.promise.move(0.0101);
  EXPECT_TRUE(detector.detect().collides());
  EXPECT_EQ(detector.detect().statistics.violations, 0U);
}

/// A bound begins with positions at rest and what has been promised since it was made. Here it is made long after that,
/// while it cannot see the points.
TEST(Own_displacement, that_is_made_while_positions_are_given_knows_where_the_points_are) {
  const Surface_mesh a = icosphere(12);
  Surface_mesh b = icosphere(12);
  shift(b, 9);
  const Lipschitz_promise nothing(std::numeric_limits<double>::infinity());
  using Make_anew = std::function<void(Detector<>&)>;
  for (const Make_anew& make_anew : {Make_anew([&](Detector<>& detector) { detector.promise(0, nothing); }),
                                     Make_anew([](Detector<>& detector) { detector.load(0, detector.save(0)); })}) {
    Promised_points<Displacement_promise> points(a);
    Detector detector({.mode = Mode::certified});
    detector.add(a, point_map(a, points));
    detector.add(std::as_const(b));
    detector.detect();
    points.shift(8, 0);
    points.promise.move(8.008);
    EXPECT_TRUE(detector.detect().collides());
    detector.update(0, far_from(points));
    make_anew(detector);
    EXPECT_FALSE(detector.detect().collides());
    detector.update(0);
    EXPECT_TRUE(detector.detect().collides());
    EXPECT_EQ(detector.detect().statistics.violations, 0U);
  }
}

/// Points with a promise of their own that can be replaced by others.
struct Replaced_points : Promised_points<Stretch_promise> {
  using Promised_points::Promised_points;
  std::uint64_t shape = 1;

  std::uint64_t shape_number() const { return shape; }
  /// Others, so many times as large.
  void replace(double factor) {
    for (double& x : now) x *= factor;
    ++number, ++shape;
  }
};

TEST(Own_stretch, of_points_that_are_replaced_counts_from_where_the_new_ones_are_first) {
  const Surface_mesh a = icosphere(12);
  Surface_mesh b = icosphere(12);
  shift(b, 0, 6);
  Replaced_points points(a);
  Detector detector({.mode = Mode::certified});
  detector.add(a, point_map(a, points));
  detector.add(std::as_const(b));
  for (const bool large : {false, true, false, true}) {
    for (int frame = 0; frame < 3; ++frame) {  // the first makes the bound, and reads everything
      const Frame& found = detector.detect();
      EXPECT_EQ(found.collides(), large) << frame;
      EXPECT_EQ(found.statistics.violations, 0U) << frame;
      points.shift(frame == 1 ? -0.01 : 0.01, 0);
    }
    points.replace(large ? 0.2 : 5.5);
  }
}

}  // namespace
}  // namespace lodestone
