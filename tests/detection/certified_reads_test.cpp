// SPDX-License-Identifier: GPL-3.0-or-later
// Mode certified, where a vertex breaks a promise and is read without its leaf.
#include <limits>
#include <utility>

#include "detection/certified_scene.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

Detector_options certified(bool throws, bool containment = false) {
  return {.mode = Mode::certified, .exact = {.containment = containment, .throw_if_broken = throws}};
}

TEST(Certified_reads, notice_an_inner_object_that_has_left_its_promise_in_containment) {
  const Surface_mesh at_first = sphere(8);
  for (const bool throws : {false, true}) {
    Surface_mesh outer = sphere(25), inner = at_first;
    scale(outer, 10);
    Displacement_promise of_outer, of_inner;
    Detector detector(certified(throws, true)), exact(Detector_options{.exact = {.containment = true}});
    for (Detector<>* each : {&detector, &exact}) {
      each->add(std::as_const(outer));
      each->add(std::as_const(inner));
    }
    detector.promise(0, of_outer), detector.promise(1, of_inner);
    EXPECT_EQ(detector.detect().pairs.at(0).containment, Containment::b_in_a);
    scale(inner, 8);
    shift(inner, 0, 0, 5);  // it crosses the outer one now, against the promise
    if (throws) {
      EXPECT_THROW(detector.detect(), Broken_bound);
      continue;
    }
    EXPECT_FALSE(detector.contains(0, 1));
    const Frame& found = detector.detect();
    EXPECT_TRUE(found.collides());
    EXPECT_EQ(found.pairs.at(0).containment, Containment::none);
    expect_same_answers(found, exact.detect(), 2);
  }
}

/// A surface that moves as a whole, and has promised not to; and a small one that it then meets.
template <class Promise>
void expect_notices_a_move(const Promise& kept) {
  for (const auto& [throws, placed] : {std::pair(false, false), {true, false}, {false, true}, {true, true}}) {
    Surface_mesh body = long_body(40, 1), ball = sphere(4);
    scale(ball, 0.2);
    shift(ball, 0, 0, 2);
    const Box_promise still([](Region_index, const Aabb& rest) { return rest; });
    Detector detector(certified(throws)), exact(Detector_options{});
    for (Detector<>* each : {&detector, &exact}) {
      each->add(std::as_const(body));
      each->add(std::as_const(ball));
    }
    detector.promise(0, still), detector.promise(0, kept);
    Eigen::Isometry3d elsewhere(Eigen::Translation3d(5, 0, 0));  // and turned by a right angle: boxes stay tight
    elsewhere.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    for (Detector<>* each : {&detector, &exact})
      for (const Object_id object : {0, 1})
        if (placed) each->place(object, elsewhere);
    EXPECT_FALSE(detector.detect().collides());
    EXPECT_EQ(detector.detect().statistics.violations, 0U);
    shift(body, 0, 0, 1.5);
    if (throws) {
      EXPECT_THROW(detector.detect(), Broken_bound);
      continue;
    }
    const Frame& found = detector.detect();
    EXPECT_TRUE(found.collides());
    EXPECT_GT(found.statistics.violations, 0U);
    expect_same_answers(found, exact.detect(), 2);
  }
}

TEST(Certified_reads, notice_an_anchor_outside_another_promise) { expect_notices_a_move(Lipschitz_promise(1, 1e-9)); }

TEST(Certified_reads, notice_a_landmark_outside_another_promise) { expect_notices_a_move(Stretch_promise(1, 1e-9)); }

TEST(Certified_reads, refuse_an_anchor_that_is_not_finite_rather_than_say_that_a_promise_is_broken) {
  Surface_mesh body = long_body(40, 1);
  Surface_mesh ball = sphere(4);
  shift(ball, 0, 0, 20);  // so that nothing else is read
  const Box_promise still([](Region_index, const Aabb& rest) { return rest; });
  const Lipschitz_promise kept(1, 1e-9);
  Detector detector(certified(true));
  detector.add(std::as_const(body)), detector.add(std::as_const(ball));
  detector.promise(0, still), detector.promise(0, kept);
  detector.detect();
  deform(body, [](const Point& p) { return Point(p.x(), std::numeric_limits<double>::quiet_NaN(), p.z()); });
  EXPECT_THROW(detector.detect(), Bad_mesh);
}

}  // namespace
}  // namespace lodestone
