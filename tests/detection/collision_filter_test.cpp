// SPDX-License-Identifier: GPL-3.0-or-later
// Which pairs of objects a detector looks at, in every mode.
#include "lodestone/detection/collision_filter.h"

#include <gtest/gtest.h>

#include <set>

#include "support/exact_truth.h"

namespace lodestone {
namespace {

using Id_pair = std::pair<Object_id, Object_id>;

/// Balls that all meet one another: with regions that hold everything, the particles find all of it too.
class Filter_in_mode : public testing::TestWithParam<Mode> {
 protected:
  Detector<> detector{{.mode = GetParam(), .particles = 1}};
  std::deque<Surface_mesh> balls;

  void add(const Object_options& options = {}) {
    balls.push_back(sphere(4, 1, {0.3 * static_cast<double>(balls.size()), 0.1, 0.05}));
    detector.add(balls.back(), options);
  }
  /// The pairs that collide in the next frame; all that is listed must be true.
  std::set<Id_pair> colliding() {
    std::set<Id_pair> result;
    const Frame& frame = detector.detect();
    for (const auto& pair : frame.pairs) {
      EXPECT_TRUE(pair.collides);
      expect_contacts(frame, pair.a, pair.b, exhaustive_face_pairs(balls[pair.a], balls[pair.b]));
      result.emplace(pair.a, pair.b);
    }
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(modes, Filter_in_mode, testing::Values(Mode::particles, Mode::exact), [](const auto& tested) {
  return std::string(tested.param == Mode::exact ? "exact" : "particles");
});

TEST_P(Filter_in_mode, without_filters_all_pairs_are_looked_at) {
  for (int i = 0; i < 3; ++i) add();
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 1}, {0, 2}, {1, 2}}));
}

TEST_P(Filter_in_mode, an_ignored_pair_is_left_out_until_it_is_taken_in_again) {
  for (int i = 0; i < 3; ++i) add();
  detector.ignore(0, 2);
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 1}, {1, 2}}));
  detector.ignore(2, 0);  // again, the other way round
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 1}, {1, 2}}));
  detector.ignore(1, 0);
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{1, 2}}));
  detector.ignore(2, 0, false);
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 2}, {1, 2}}));
  detector.ignore(0, 1, false);
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 1}, {0, 2}, {1, 2}}));
}

TEST_P(Filter_in_mode, what_is_ignored_is_still_ignored_when_objects_join) {
  add(), add();
  detector.ignore(0, 1);
  EXPECT_TRUE(colliding().empty());
  add();
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 2}, {1, 2}}));
}

TEST_P(Filter_in_mode, objects_collide_where_each_meets_a_group_of_the_other) {
  add({.groups = 1, .meets = 2});
  add({.groups = 2, .meets = 1});
  add({.groups = 2, .meets = 4});  // does not meet object 0, which would meet it
  add({.groups = 1 | 4, .meets = 2});
  add({.groups = 8, .meets = 1});  // meets objects 0 and 3, which would not meet it
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 1}, {1, 3}, {2, 3}}));
}

TEST_P(Filter_in_mode, the_highest_group_is_like_any_other) {
  constexpr std::uint32_t highest = 1U << 31;
  add({.groups = highest, .meets = highest});
  add({.groups = highest, .meets = highest});
  add({.groups = 1, .meets = ~highest});
  add();
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 1}, {2, 3}}));
}

TEST_P(Filter_in_mode, an_object_without_a_group_or_that_meets_none_collides_with_nothing) {
  add({.groups = 0});
  add({.meets = 0});
  add(), add();
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{2, 3}}));
}

TEST_P(Filter_in_mode, unknown_objects_are_refused) {
  add(), add();
  EXPECT_THROW(detector.ignore(0, 2), Bad_argument);
  EXPECT_THROW(detector.ignore(2, 1), Bad_argument);
  EXPECT_THROW(detector.ignore(7, 7, false), Bad_argument);
  EXPECT_EQ(colliding(), (std::set<Id_pair>{{0, 1}}));
}

TEST(Collision_filter, leaves_a_single_pair_out_too) {
  const auto a = sphere(4), b = sphere(4, 1, {0.5, 0, 0});
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  detector.ignore(1, 0);
  EXPECT_FALSE(detector.detect(0, 1).collides());
  EXPECT_EQ(detector.closest(0, 1).points.distance, 0);  // no collision is asked for
  detector.ignore(0, 1, false);
  EXPECT_TRUE(detector.detect(0, 1).collides());
}

TEST(Collision_filter, leaves_containment_out_too) {
  const auto outer = sphere(6), inner = sphere(4, 0.3);
  Exact_detector detector({.mode = Mode::exact, .exact = {.containment = true}});
  add_all(detector, {&outer, &inner});
  EXPECT_EQ(detector.detect().pairs.size(), 1U);
  detector.ignore(0, 1);
  EXPECT_TRUE(detector.detect().pairs.empty());
}

TEST(Collision_filter, an_ignored_pair_does_not_ignore_the_objects_themselves) {
  Collision_filter filter;
  filter.add({}), filter.add({});
  filter.ignore({1, 0}, true);
  EXPECT_FALSE(filter.may_collide(0, 1));
  EXPECT_FALSE(filter.may_collide(1, 0));
  EXPECT_TRUE(filter.may_collide(0, 0));
  filter.ignore({0, 0}, true);
  EXPECT_FALSE(filter.may_collide(0, 0));
  EXPECT_TRUE(filter.may_collide(1, 1));
}

TEST(Collision_filter, forgets_the_ignored_pairs_of_a_removed_object_and_no_others) {
  Collision_filter filter;
  for (int o = 0; o < 4; ++o) filter.add({});
  for (const Object_pair pair : {Object_pair{1, 0}, {1, 2}, {1, 1}, {3, 2}}) filter.ignore(pair, true);
  filter.remove(1);
  EXPECT_FALSE(filter.may_collide(1, 1));
  for (const std::uint32_t other : {0, 2, 3})
    EXPECT_FALSE(filter.may_collide(1, other) || filter.may_collide(other, 1));
  EXPECT_FALSE(filter.may_collide(2, 3));
  EXPECT_FALSE(filter.may_collide(3, 2));
  EXPECT_TRUE(filter.may_collide(0, 2));
  EXPECT_TRUE(filter.may_collide(0, 3));
  filter.ignore({2, 3}, false);
  EXPECT_TRUE(filter.may_collide(2, 3));
}

}  // namespace
}  // namespace lodestone
