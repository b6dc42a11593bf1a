// SPDX-License-Identifier: GPL-3.0-or-later
// Promises in mode certified: what counts as at rest, and which regions they are about.
#include <algorithm>
#include <limits>
#include <random>

#include "detection/certified_scene.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/mesh/errors.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

/// A body that moves along x, as it promises, towards another, and a third one.
struct Promises_about_rest : testing::Test {
  Surface_mesh a = icosphere(3), b = icosphere(3), c = icosphere(2);
  double moved = 0;  ///< since a was at rest
  const Box_promise promise{[this](Region_index, const Aabb& rest) {
    Aabb box = rest;
    box.low[0] += moved - 1e-9, box.high[0] += moved + 1e-9;
    return box;
  }};
  Detector<> certified{in_mode(Mode::certified, {})};

  Promises_about_rest() {
    shift(b, 50), shift(c, 90);
    for (const auto* mesh : {&a, &b, &c}) certified.add(*mesh);
  }
  void expect_true_promise_and_contact() {
    shift(a, 8), moved += 8;
    EXPECT_FALSE(certified.detect().collides());
    shift(b, -41.5);
    const Frame& found = certified.detect();
    EXPECT_TRUE(found.collides());
    EXPECT_EQ(found.statistics.violations, 0U);
  }
};

/// Nobody has asked about the body that promises when it is at rest.
TEST_F(Promises_about_rest, take_the_first_query_whichever_objects_it_is_about) {
  certified.promise(0, promise);
  certified.detect(1, 2);
  expect_true_promise_and_contact();
}

TEST_F(Promises_about_rest, take_another_one_after_a_rebuild) {
  certified.promise(0, promise);
  certified.detect();
  shift(a, -3);
  certified.rebuild(0);
  EXPECT_TRUE(certified.first_hit(1, Ray{.origin = {40, 0.1, 0.1}, .direction = {1, 0, 0}}));
  shift(b, -3);
  expect_true_promise_and_contact();
}

struct Never_fits {
  Promised_boxes bound(const Bounded_object&) const { throw Bad_argument("of another object"); }
};

TEST_F(Promises_about_rest, that_are_dropped_leave_no_rest_to_the_next) {
  const Never_fits misfit;
  certified.promise(0, misfit);
  EXPECT_THROW(certified.detect(), Bad_argument);
  shift(a, -3), shift(b, -3);
  certified.promise(0, promise);
  certified.detect();
  expect_true_promise_and_contact();
}

/// A query about others does not fail because of it.
TEST_F(Promises_about_rest, wait_until_the_mesh_can_be_read) {
  certified.promise(0, promise);
  const Surface_mesh::Vertex_index first(0);
  const Point whole = a.point(first);
  a.point(first) = Point(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_FALSE(certified.detect(1, 2).collides());
  a.point(first) = whole;
  shift(a, -3), shift(b, -3);
  EXPECT_FALSE(certified.detect(1, 2).collides());  // at rest now
  expect_true_promise_and_contact();
}

/// Its bound is made by the first query about the object.
template <class Promise>
void expect_that_it_is_noticed_before_its_bound_is_made(const Promise& rigid) {
  for (const bool throws : {false, true}) {
    Surface_mesh a = icosphere(3), b = icosphere(3), c = icosphere(2);
    shift(b, 50), shift(c, 90);
    Detector certified({.mode = Mode::certified, .exact = {.throw_if_broken = throws}});
    for (const auto* mesh : {&a, &b, &c}) certified.add(*mesh);
    certified.promise(0, rigid);
    certified.detect(1, 2);  // a is at rest now
    deform(a, [](const Point& p) { return Point(3 * p.x(), p.y(), p.z()); });
    if (throws) {
      EXPECT_THROW(certified.save(0), Broken_bound);
    } else {
      EXPECT_GT(certified.detect().statistics.violations, 0U);
    }
  }
}

TEST(Certified, promises_that_are_broken_before_their_bound_is_made_are_noticed) {
  expect_that_it_is_noticed_before_its_bound_is_made(Stretch_promise());
  expect_that_it_is_noticed_before_its_bound_is_made(Lipschitz_promise());
  expect_that_it_is_noticed_before_its_bound_is_made(Box_promise([](Region_index, const Aabb& rest) { return rest; }));
}

/// Moves the vertices of a grid up and down so far that its leaves are much larger than before.
void crease(Surface_mesh& sheet, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> height(-20, 20);
  deform(sheet, [&](const Point& p) { return Point(p.x(), p.y(), height(random)); });
}

/// A promise is about the regions that the caller has seen.
TEST(Certified, objects_keep_their_regions_once_something_is_promised) {
  Surface_mesh sheet = grid(40, 40), ball = icosphere(2);
  shift(ball, 90);
  const Surface_mesh flat = sheet;
  Detector detector({.mode = Mode::certified, .particles = 12});
  detector.add(std::as_const(sheet)), detector.add(std::as_const(ball));
  detector.detect();
  const auto seen = detector.regions(0);
  const Displacement_promise displacement(*std::ranges::max_element(seen) + 1);
  const Stretch_promise stretch(1e9);
  const auto expect_same_regions = [&](std::uint64_t seed) {
    crease(sheet, seed);
    EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
    EXPECT_EQ(detector.regions(0), seen);
  };
  detector.promise(0, displacement);
  expect_same_regions(1);
  detector.promise(0, stretch);
  expect_same_regions(2);

  sheet = flat;
  Detector unpromised({.mode = Mode::certified, .particles = 12});
  unpromised.add(std::as_const(sheet)), unpromised.add(std::as_const(ball));
  unpromised.detect();
  crease(sheet, 1);
  EXPECT_EQ(unpromised.detect().statistics.repartitions, 1U);
}

TEST(Certified, displacements_of_regions_need_an_object_that_has_some) {
  const Surface_mesh a = icosphere(3), b = icosphere(3);
  const Displacement_promise of_regions(4);
  Detector detector({.mode = Mode::certified});
  detector.add(a), detector.add(b);
  detector.promise(0, of_regions);
  const auto message = message_of<Bad_argument>([&] { detector.detect(); });
  EXPECT_NE(message.find("4 regions, the object has none"), std::string::npos) << message;
}

}  // namespace
}  // namespace lodestone
