// SPDX-License-Identifier: GPL-3.0-or-later
// Promises in mode certified, kept and broken.
#include <CGAL/boost/graph/Euler_operations.h>

#include <limits>
#include <utility>

#include "detection/certified_scene.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

/// How far any vertex is from where it was.
double largest_move(const Surface_mesh& now, const Surface_mesh& before) {
  double largest = 0;
  for (const auto v : now.vertices())
    largest = std::max(largest, std::sqrt(CGAL::squared_distance(now.point(v), before.point(v))));
  return largest * (1 + 1e-12);
}

/// Two bodies that crumple and drift towards each other, in meshes.
struct Drifting {
  Surface_mesh a = long_body(72, 1), b = long_body(64, 2), a_before = a, b_before = b;

  Drifting() { place_b(gap_at_first); }
  /// Where b's leftmost vertex is that far beyond a's rightmost.
  void place_b(double gap) {
    double right = -1e9, left = 1e9;
    for (const auto v : a.vertices()) right = std::max(right, a.point(v).x());
    for (const auto v : b.vertices()) left = std::min(left, b.point(v).x());
    shift(b, right + gap - left);
  }
  static constexpr double gap_at_first = 1;
  void step(int frame) {
    a_before = a, b_before = b;
    crumple(a, 0.004, static_cast<std::uint64_t>(frame));
    crumple(b, 0.004, static_cast<std::uint64_t>(frame) + 100);
    shift(b, frame < 30 ? -0.05 : 0.05, 0.01 * std::sin(frame));
  }
};

TEST(Certified, meshes_with_a_displacement_have_the_answers_of_mode_exact) {
  Drifting bodies;
  Displacement_promise of_a, of_b;
  Detector certified(Detector_options{.mode = Mode::certified}), exact(Detector_options{});
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
  }
  certified.promise(0, of_a);
  certified.promise(1, of_b);
  std::size_t read = 0, colliding = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    EXPECT_EQ(found.statistics.violations, 0U);
    if (frame > 0) read += found.statistics.vertices_read;
    colliding += found.collides() ? 1 : 0;
    bodies.step(frame);
    of_a.move(largest_move(bodies.a, bodies.a_before));
    of_b.move(largest_move(bodies.b, bodies.b_before));
  }
  EXPECT_GT(colliding, 5U);
  EXPECT_LT(colliding, 55U);
  EXPECT_LT(read, 59 * (bodies.a.number_of_vertices() + bodies.b.number_of_vertices()) / 3);
}

TEST(Certified, several_promises_hold_together_and_may_come_late) {
  Drifting bodies;
  const Surface_mesh rest_a = bodies.a, rest_b = bodies.b;
  Displacement_promise of_a;
  Stretch_promise stretch_of_a(50), stretch_of_b(50);  // crumpling makes short edges much longer
  Lipschitz_promise of_b(100);
  const Box_promise somewhere([](Region_index, const Aabb& rest) {
    Aabb box = rest;
    for (int axis = 0; axis < 3; ++axis) box.low[axis] -= 20, box.high[axis] += 20;
    return box;
  });
  Detector certified(in_mode(Mode::certified, {.particles = 5})), exact(in_mode(Mode::exact, {.particles = 5}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
  }
  for (int frame = 0; frame < 50; ++frame) {
    if (frame == 0) certified.promise(0, stretch_of_a), certified.promise(1, stretch_of_b);
    if (frame == 3) certified.promise(0, of_a), certified.promise(1, of_b), certified.promise(1, somewhere);
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    EXPECT_EQ(found.statistics.violations, 0U) << frame;
    bodies.step(frame);
    of_a.move(largest_move(bodies.a, bodies.a_before));
  }
}

/// Places an object anew in each frame, and moves its vertices in some.
template <class Promise, class Step>
void expect_same_answers_wherever_it_is_placed(const Promise& promise, const Step& step) {
  Drifting bodies;
  bodies.place_b(-1);
  Detector certified({.mode = Mode::certified, .exact = {.throw_if_broken = true}}), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
  }
  certified.promise(0, promise);
  std::size_t colliding = 0;
  for (int frame = 0; frame < 30; ++frame) {
    Eigen::Isometry3d placement(Eigen::AngleAxisd(0.3 * frame, Eigen::Vector3d(0.6, 0, 0.8)));
    placement.translation() = Eigen::Vector3d(3 * std::sin(frame), 0.2 * std::cos(frame), 0.1);
    for (Detector<>* detector : {&certified, &exact})
      detector->place(0, frame % 7 == 6 ? Eigen::Isometry3d::Identity() : placement);
    if (frame % 3 == 2) step(bodies.a, frame);
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    EXPECT_EQ(certified.closest(0, 1).points.distance, exact.closest(0, 1).points.distance) << frame;
    colliding += found.collides() ? 1 : 0;
  }
  EXPECT_GT(colliding, 3U);
  EXPECT_LT(colliding, 27U);
}

TEST(Certified, promises_need_not_say_where_an_object_is_placed) {
  {
    SCOPED_TRACE("a rigid body");
    expect_same_answers_wherever_it_is_placed(Displacement_promise(), [](Surface_mesh&, int) {});
  }
  {
    SCOPED_TRACE("displacement");
    Displacement_promise promise;
    expect_same_answers_wherever_it_is_placed(promise, [&](Surface_mesh& mesh, int frame) {
      const Surface_mesh before = mesh;
      crumple(mesh, 0.01, static_cast<std::uint64_t>(frame));
      promise.move(largest_move(mesh, before));
    });
  }
  {
    SCOPED_TRACE("stretch and distance");
    const auto crumpled = [](Surface_mesh& mesh, int frame) { crumple(mesh, 0.01, static_cast<std::uint64_t>(frame)); };
    expect_same_answers_wherever_it_is_placed(Stretch_promise(50), crumpled);
    expect_same_answers_wherever_it_is_placed(Lipschitz_promise(100), crumpled);
  }
  {
    SCOPED_TRACE("boxes");
    constexpr double rounding = 1e-12;
    double moved = 0;
    const Box_promise promise([&](Region_index, const Aabb& rest) {
      Aabb box = rest;
      box.low[1] += moved - rounding, box.high[1] += moved + rounding;
      return box;
    });
    expect_same_answers_wherever_it_is_placed(promise, [&](Surface_mesh& mesh, int) {
      shift(mesh, 0, 0.125);
      moved += 0.125;
    });
  }
}

TEST(Certified, a_broken_promise_of_a_placed_object_is_noticed) {
  Drifting bodies;
  bodies.place_b(-0.2);
  const Displacement_promise nothing_moves;
  Detector strict({.mode = Mode::certified, .exact = {.throw_if_broken = true}}),
      certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&strict, &certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
    detector->place(0, Eigen::Isometry3d(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX())));
  }
  for (Detector<>* detector : {&strict, &certified}) detector->promise(0, nothing_moves), detector->detect();
  crumple(bodies.a, 0.02, 7);
  EXPECT_THROW(strict.detect(), Broken_bound);
  const Frame& found = certified.detect();
  EXPECT_GT(found.statistics.violations, 0U);
  expect_same_answers(found, exact.detect(), 2);
}

TEST(Certified, a_promise_that_is_made_while_positions_are_given_counts_once_the_mesh_is_finite) {
  for (const bool late : {false, true}) {
    Drifting bodies;
    bodies.place_b(1);
    Displacement_promise of_a;
    const Lipschitz_promise lipschitz(100);
    Detector certified({.mode = Mode::certified, .exact = {.throw_if_broken = true}}), exact(in_mode(Mode::exact, {}));
    Positions given(static_cast<Eigen::Index>(bodies.a.number_of_vertices()), 3);
    for (const auto v : bodies.a.vertices()) {
      const Point& p = bodies.a.point(v);
      given.row(static_cast<Eigen::Index>(v.idx())) << p.x() + 0.5, p.y(), p.z();
    }
    for (Detector<>* detector : {&certified, &exact}) {
      detector->add(std::as_const(bodies.a));
      detector->add(std::as_const(bodies.b));
      detector->update(0, given);
    }
    Point& third = bodies.a.point(Surface_mesh::Vertex_index(3));
    const Point finite = std::exchange(third, Point(std::numeric_limits<double>::quiet_NaN(), 0, 0));
    certified.promise(0, of_a);
    certified.promise(0, lipschitz);
    expect_same_answers(certified.detect(), exact.detect(), 2);
    third = finite;
    for (Detector<>* detector : {&certified, &exact}) {
      if (late) detector->update(0, given), detector->detect();
      detector->update(0);
    }
    for (int frame = 0; frame < 8; ++frame) {
      const Surface_mesh before = bodies.a;
      crumple(bodies.a, 0.004, static_cast<std::uint64_t>(frame));
      of_a.move(largest_move(bodies.a, before));
      shift(bodies.b, -0.2);
      expect_same_answers(certified.detect(), exact.detect(), 2);
    }
    EXPECT_TRUE(certified.bounded(0)->has_bounds());
  }
}

TEST(Certified, a_displacement_that_is_larger_than_promised_is_noticed_where_it_is_read) {
  Drifting bodies;
  Displacement_promise of_a;
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
  }
  certified.promise(0, of_a);
  bodies.place_b(-1);
  certified.detect();
  std::size_t violations = 0;
  for (int frame = 0; frame < 5; ++frame) {
    crumple(bodies.a, 0.01, static_cast<std::uint64_t>(frame));  // nothing is promised: it may not move
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    violations += found.statistics.violations;
  }
  EXPECT_GT(violations, 0U);
}

TEST(Certified, a_body_inside_another_is_found_though_its_bound_sticks_out) {
  const Surface_mesh outer = potato(9), inner = sphere(5, 0.1);
  const Box_promise loose([](Region_index, const Aabb& rest) {
    Aabb box = rest;
    for (int axis = 0; axis < 3; ++axis) box.low[axis] -= 20, box.high[axis] += 20;
    return box;
  });
  Detector certified(in_mode(Mode::certified, {.exact = {.containment = true}}));
  certified.add(outer);
  certified.add(inner);
  certified.promise(1, loose);
  EXPECT_EQ(certified.detect().pairs.at(0).containment, Containment::b_in_a);
  EXPECT_EQ(certified.detect().pairs.at(0).containment, Containment::b_in_a);  // the first frame reads everything
  EXPECT_TRUE(certified.contains(0, 1));
  EXPECT_FALSE(certified.contains(1, 0));
}

TEST(Certified, promises_need_the_mode_certified) {
  const Surface_mesh mesh = potato(5);
  const Displacement_promise promise;
  Detector exact, particles({.mode = Mode::particles}), certified({.mode = Mode::certified});
  for (Detector<>* detector : {&exact, &particles, &certified}) detector->add(mesh);
  EXPECT_THROW(exact.promise(0, promise), Bad_argument);
  EXPECT_THROW(particles.promise(0, promise), Bad_argument);
  EXPECT_THROW(certified.promise(1, promise), Bad_argument);
  EXPECT_NO_THROW(certified.promise(0, promise));
}

/// Points that promise a box which ends too early along x.
struct Liar {
  Skinned_points points;
  double end = -0.5;

  std::uint32_t vertex_count() const { return points.vertex_count(); }
  std::uint64_t pose_number() const { return points.pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const { return points(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> to) const { points.pose(vertices, to); }
  void pose_all(std::span<double> to) const { points.pose_all(to); }

  struct Lie {
    Skin_bound truth;
    const double* end;
    std::size_t node_count() const { return truth.node_count(); }
    Aabb box(std::uint32_t node) const {
      Aabb box = truth.box(node);
      box.high[0] = std::min(box.high[0], *end);
      box.low[0] = std::min(box.low[0], box.high[0]);
      return box;
    }
  };
  Lie bound(const Bounded_object& object) const { return {{points, object.layout}, &end}; }
};

TEST(Certified, a_broken_bound_is_counted_and_answered_by_an_exact_pass) {
  Surface_mesh a = long_body(12, 1), b = potato(8, 2), c = potato(8, 3);
  Liar a_points{limb(a)};
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(a, point_map(a, a_points));
    detector->add(std::as_const(b));
    detector->add(std::as_const(c));
  }
  deform(b, [](const Point& p) { return Point(p.x() + 2.4, p.y(), p.z()); });  // beyond the box that is promised
  deform(c, [](const Point& p) { return Point(p.x() - 1.5, p.y(), p.z()); });
  for (int frame = 0; frame < 4; ++frame) {
    bend(a_points.points, 0.1 * frame, {0, 0, 0});
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 3);
    EXPECT_EQ(found.pairs.size(), exact.detect().pairs.size());
    EXPECT_GT(found.statistics.violations, 0U) << frame;
  }
  a_points.end = 100;  // the truth
  bend(a_points.points, 0.7, {0, 0, 0});
  EXPECT_EQ(certified.detect().statistics.violations, 0U);
  expect_same_answers(certified.detect(), exact.detect(), 3);
}

TEST(Certified, a_broken_bound_is_an_error_on_request) {
  Surface_mesh a = long_body(12, 1), c = potato(8, 3);
  Liar a_points{limb(a)};
  Detector detector({.mode = Mode::certified, .exact = {.throw_if_broken = true}});
  detector.add(a, point_map(a, a_points), {.name = "a liar"});
  detector.add(std::as_const(c));
  deform(c, [](const Point& p) { return Point(p.x() - 1, p.y(), p.z()); });
  const double lie = std::exchange(a_points.end, 100);
  detector.detect();
  a_points.end = lie;
  detector.rebuild(1);
  bend(a_points.points, 0.2, {0, 0, 0});
  const auto message = message_of<Broken_bound>([&] { detector.detect(); });
  EXPECT_NE(message.find("object 0 (a liar)"), std::string::npos) << message;
  bend(a_points.points, 0.3, {0, 0, 0});
  EXPECT_THROW(detector.visit(0, 1, [](Face_pair) { return Visit::go_on; }), Broken_bound);
  a_points.end = 100;
  bend(a_points.points, 0.2, {0, 0, 0});
  const Frame& frame = detector.detect();
  EXPECT_TRUE(frame.collides());
  EXPECT_EQ(frame.statistics.builds, 1U);  // no frame has told it yet
  EXPECT_EQ(detector.detect().statistics.builds, 0U);
}

/// A ball that jumps into another. What its promises say of small parts has no point in common, nor, if it jumps
/// farther than it is wide, what they say of the whole. Otherwise the other ball is near what they say of the whole.
struct Contradiction {
  Surface_mesh a = icosphere(12), b = icosphere(12);
  double at = 0;
  Displacement_promise nothing_moves;
  Box_promise shifted{[this](Region_index, const Aabb& rest) {
    Aabb box = rest;
    box.low[0] += at, box.high[0] += at;
    return box;
  }};

  void start(Detector<>& detector, double jump) {
    shift(b, jump + 0.5, 1.3, 1.3);
    detector.add(std::as_const(a));
    detector.add(std::as_const(b));
    detector.promise(0, nothing_moves);
    detector.promise(0, shifted);
    EXPECT_FALSE(detector.detect().collides());
    at = jump;
    shift(a, at);
  }
};

TEST(Certified, promises_that_contradict_each_other_are_broken) {
  for (const double jump : {1.2, 8.0}) {
    const auto answers = [jump](const auto& ask) {
      Contradiction scene;
      Detector detector({.mode = Mode::certified});
      scene.start(detector, jump);
      return ask(detector);
    };
    EXPECT_TRUE(answers([](auto& detector) { return detector.detect().collides(); }));
    EXPECT_GT(answers([](auto& detector) { return detector.detect().statistics.violations; }), 0U);
    EXPECT_TRUE(answers([](auto& detector) { return detector.detect(0, 1).collides(); }));
    EXPECT_TRUE(answers([](auto& detector) { return detector.within(0, 1, 0.1); }));
    EXPECT_EQ(answers([](auto& detector) { return detector.closest(0, 1).points.distance; }), 0);
    EXPECT_EQ(answers([jump](auto& detector) { return detector.point_side(0, Point(jump - 0.5, 0, 0)); }),
              Point_side::inside);
    EXPECT_EQ(answers([](auto& detector) { return detector.visit(0, 1, [](Face_pair) { return Visit::stop; }); }),
              Visit::stop);
  }
}

TEST(Certified, promises_that_contradict_each_other_are_an_error_on_request) {
  Contradiction scene;
  Detector detector({.mode = Mode::certified, .exact = {.throw_if_broken = true}});
  scene.start(detector, 8);
  EXPECT_THROW(detector.detect(), Broken_bound);
  EXPECT_THROW(detector.detect(), Broken_bound);  // nothing has been corrected
  scene.nothing_moves.move(8.1);
  EXPECT_TRUE(detector.detect().collides());
}

TEST(Certified, promises_may_be_corrected_in_the_same_pose) {
  Surface_mesh a = long_body(12, 1), b = long_body(12, 2);
  Liar a_points{limb(a)}, b_points{limb(b)};  // in poses that are numbered
  a_points.end = b_points.end = 100;
  Lipschitz_promise of_a(1.0000001, 1e-9), of_b(1.0000001, 1e-9);
  Detector detector({.mode = Mode::certified, .exact = {.throw_if_broken = true}});
  detector.add(a, point_map(a, a_points));
  detector.add(b, point_map(b, b_points));
  detector.promise(0, of_a);
  detector.promise(1, of_b);
  detector.detect();
  for (Liar* points : {&a_points, &b_points})
    points->points.set_joints(std::vector<Eigen::Affine3d>(2, Eigen::Affine3d(Eigen::Scaling(1.3))));
  EXPECT_THROW(detector.detect(), Broken_bound);
  EXPECT_THROW(detector.detect(), Broken_bound);
  of_a.set_constant(1.3000001, 1e-9);
  of_b.set_constant(1.3000001, 1e-9);
  EXPECT_TRUE(detector.detect().collides());
  EXPECT_TRUE(detector.first_hit(0, {.origin = {0, 0, 9}, .direction = {0, 0, -1}}).has_value());
}

TEST(Certified, a_promise_that_does_not_fit_is_dropped_with_an_error) {
  Surface_mesh a = potato(8, 1), b = potato(8, 2);
  Displacement_promise four_regions(4), fits;
  Detector detector({.mode = Mode::certified, .particles = 8});
  detector.add(a, {.name = "a body"});
  detector.add(b);
  detector.promise(0, four_regions);
  detector.promise(0, fits);
  const auto message = message_of<Bad_argument>([&] { detector.detect(); });
  EXPECT_NE(message.find("object 0 (a body)"), std::string::npos) << message;
  EXPECT_TRUE(detector.detect().collides());
  EXPECT_TRUE(detector.bounded(0)->has_bounds());
  shift(a, 100);
  fits.move(100.1);
  EXPECT_FALSE(detector.detect().collides());
}

TEST(Certified, a_stretch_counts_anew_from_where_the_vertices_are_when_faces_have_changed) {
  Surface_mesh a = icosphere(12), b = icosphere(12);
  shift(b, 0, 6);
  const Stretch_promise stretch;
  Detector detector({.mode = Mode::certified});
  detector.add(a), detector.add(std::as_const(b));
  detector.promise(0, stretch);
  EXPECT_FALSE(detector.detect().collides());
  scale(a, 5.5);
  CGAL::Euler::flip_edge(Surface_mesh::Halfedge_index(0), a);
  detector.rebuild(0);
  for (int frame = 0; frame < 3; ++frame) {  // the first makes the bound, and reads everything
    const Frame& found = detector.detect();
    EXPECT_TRUE(found.collides()) << frame;
    EXPECT_EQ(found.statistics.violations, 0U) << frame;
    shift(a, 0.01);
    detector.update(0);
  }
}

TEST(Certified, a_bound_that_is_made_while_the_mesh_is_not_finite_hides_nothing_of_it_later) {
  // Only the tip of one body touches the other, and that is what was not finite.
  Surface_mesh a = icosphere(12), b = icosphere(12);
  const Surface_mesh::Vertex_index tip(3);
  const Point spike(a.point(tip).x() * 4, a.point(tip).y() * 4, a.point(tip).z() * 4);
  a.point(tip) = spike;
  shift(b, 1.2 * spike.x(), 1.2 * spike.y(), 1.2 * spike.z());
  const Displacement_promise of_a;  // it does not move
  Detector detector({.mode = Mode::certified});
  detector.add(std::as_const(a)), detector.add(std::as_const(b));
  detector.update(0, Numbered_mesh(icosphere(12)).positions);
  a.point(tip) = Point(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  detector.promise(0, of_a);
  EXPECT_FALSE(detector.detect().collides());
  a.point(tip) = spike;
  detector.update(0);
  for (int frame = 0; frame < 3; ++frame) {
    shift(b, 0.001);
    EXPECT_TRUE(detector.detect().collides()) << frame;
  }
}

}  // namespace
}  // namespace lodestone
