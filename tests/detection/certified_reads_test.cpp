// SPDX-License-Identifier: GPL-3.0-or-later
// Mode certified, where a vertex breaks a promise and is read without its leaf.
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
  for (const bool throws : {false, true}) {
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
    EXPECT_FALSE(detector.detect().collides());
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

}  // namespace
}  // namespace lodestone
