// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory/memory_trial.h"

#include <gtest/gtest.h>

#include <new>
#include <optional>

#include "memory/failing_memory.h"

namespace lodestone::test {

namespace {

Tried_mode tried(std::string name, std::size_t threads, Detector_options options) {
  options.threads = threads;
  options.tree.leaf_faces = 8;
  return {name + ", threads: " + std::to_string(threads), options};
}

/// What a frame answers, without its times and counts.
struct Answer {
  explicit Answer(const Frame& frame) : faces(frame.face_pairs) {
    for (const auto& pair : frame.pairs) colliding.push_back({pair.a, pair.b, pair.collides});
  }
  bool operator==(const Answer&) const = default;

  struct Pair {
    Object_id a, b;
    bool collides;
    bool operator==(const Pair&) const = default;
  };
  std::vector<Face_pair> faces;
  std::vector<Pair> colliding;
};

/// The call, then the next frame, with memory enough.
Answer expected_answer(const Tried_mode& mode, const Tried_call& tried) {
  Trial trial(mode);
  tried.before(trial);
  tried.call(trial);
  return Answer(trial.detector.detect());
}

std::size_t allocations_of(const Tried_mode& mode, const Tried_call& tried) {
  Trial trial(mode);
  tried.before(trial);
  fail_allocation(never);
  tried.call(trial);
  return allocations();
}

/// @return whether the allocation was made, and failed
bool fail_once(const Tried_mode& mode, const Tried_call& tried, std::size_t number, const Answer& expected) {
  Trial trial(mode);
  tried.before(trial);
  bool thrown = false;
  fail_allocation(number);
  try {
    tried.call(trial);
  } catch (const std::bad_alloc&) {
    thrown = true;
  }
  const bool ran_out = allocation_failed();
  fail_allocation(never);
  EXPECT_TRUE(ran_out || !thrown);
  if (thrown && tried.after) tried.after(trial);
  if (thrown && tried.repeated) tried.call(trial);
  EXPECT_TRUE(Answer(trial.detector.detect()) == expected);
  return ran_out;
}

}  // namespace

std::vector<Tried_mode> exact_modes() {
  std::vector<Tried_mode> modes;
  for (const std::size_t threads : {1, 2})
    for (const auto mode : {Mode::exact, Mode::certified})
      modes.push_back(tried(std::string(name_of(mode)), threads,
                            {.mode = mode,
                             .contact_points = true,
                             .contact_normals = true,
                             .exact = {.self_collision = true, .containment = true, .patches = true}}));
  modes.push_back(tried("exact with tolerances, over regions", 1,
                        {.mode = Mode::exact,
                         .particles = 4,
                         .exact = {.tolerance = 0.02, .self_collision = true, .self_tolerance = 0.02}}));
  return modes;
}

std::vector<Tried_mode> plain_modes() {
  return {tried("exact", 1, {.mode = Mode::exact}), tried("certified", 1, {.mode = Mode::certified})};
}

std::vector<Tried_mode> tried_modes() {
  auto modes = exact_modes();
  for (const std::size_t threads : {1, 2}) {
    const Detector_options particles{.mode = Mode::particles,
                                     .particles = 5,
                                     .contacts = Contact_query::all,
                                     .contact_points = true,
                                     .list_candidates = true};
    modes.push_back(tried("particles", threads, particles));
    auto walking = particles;
    walking.opening_budget = 20;
    modes.push_back(tried("particles that walk", threads, walking));
    auto published = particles;
    published.meetings = 0;
    modes.push_back(tried("particles as published", threads, published));
    auto scattered = particles;
    scattered.mode = Mode::senin;
    modes.push_back(tried("senin", threads, scattered));
  }
  return modes;
}

Trial::Trial(const Tried_mode& mode)
    : first(long_body(3, 1)),
      second(long_body(3, 2)),
      third(potato(2, 3)),
      first_points(limb(first)),
      second_points(limb(second)),
      detector(mode.options),
      computed_(mode.options.mode == Mode::certified) {
  shift(second, 0, 0.3, 0.1);
  pose(0);
}

void Trial::pose(int frame) {
  const double t = frame;
  bend(first_points, 0.2 * t, {0, 0.05 * t, 0});
  bend(second_points, -0.3 * t, {0.1, 0.35, 0.1 * t});
  if (frame == 0) return;
  shift(first, 0.02, 0.05, 0.01);
  shift(second, -0.03, 0, 0.04);
}

void Trial::add_all() {
  if (computed_)
    detector.add(first, point_map(first, first_points), {.name = "first"});
  else
    detector.add(std::as_const(first), {.name = "first"});
  add_second();
}

Object_id Trial::add_second() {
  return computed_ ? detector.add(second, point_map(second, second_points)) : detector.add(std::as_const(second));
}

void Trial::play(int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    pose(frame);
    detector.update();
    detector.detect();
  }
}

void expect_to_survive(const Tried_mode& mode, const Tried_call& tried) {
  SCOPED_TRACE(mode.name);
  const Answer expected = expected_answer(mode, tried);
  const std::size_t count = allocations_of(mode, tried);
  std::size_t failures = 0;
  for (std::size_t number = 0; number < count; ++number) {
    SCOPED_TRACE("allocation " + std::to_string(number) + " of " + std::to_string(count));
    const auto before = live_blocks();
    failures += fail_once(mode, tried, number, expected) ? 1 : 0;
    if (!tried.maps_are_made) {
      EXPECT_EQ(live_blocks(), before);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(failures > 0, count > 0);
}

}  // namespace lodestone::test
