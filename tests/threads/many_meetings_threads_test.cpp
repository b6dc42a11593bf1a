// SPDX-License-Identifier: GPL-3.0-or-later
// In mode `particles` pairs of objects are searched side by side: it does not show.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// 16 groups of four bodies, each of which meets the three others. So levels have 16 pairs or more: enough for several
/// workers.
std::deque<Surface_mesh> groups_of_bodies() {
  std::deque<Surface_mesh> owned;
  for (int group = 0; group < 16; ++group)
    for (int body = 0; body < 4; ++body) {
      const double x = 4 * (group % 4) + 0.6 * (body & 1), y = 4 * (group / 4) + 0.6 * (body / 2);
      owned.push_back(sphere(4 + (group + body) % 3, 0.5, {x, y, body == 3 ? 0.3 : 0}));
    }
  return owned;
}

void move_some(std::deque<Surface_mesh>& owned) {
  crumple(owned[5], 0.1, 1);
  for (std::size_t i = 0; i < owned.size(); i += 3) shift(owned[i], 0.07, -0.04, 0.02);
}

/// Positions that only the thread that made them may read.
struct Points_of_one_thread {
  const Surface_mesh* mesh = nullptr;
  std::thread::id owner = std::this_thread::get_id();
  friend Point get(const Points_of_one_thread& map, Surface_mesh::Vertex_index v) {
    if (map.owner != std::this_thread::get_id()) throw std::logic_error("read by another thread");
    return map.mesh->point(v);
  }
};

/// @param computed  every third object has positions that one thread alone may read
std::vector<Frame> frames_of_groups(Detector_options options, std::size_t threads, bool computed = false) {
  options.mode = Mode::particles;
  options.threads = threads;
  auto owned = groups_of_bodies();
  Detector<> detector(options);
  for (std::size_t i = 0; i < owned.size(); ++i) {
    if (computed && i % 3 == 0)
      detector.add(owned[i], Points_of_one_thread{&owned[i]});
    else
      detector.add(std::as_const(owned[i]));
  }
  std::vector<Frame> result;
  for (int frame = 0; frame < 4; ++frame) {
    detector.update();
    result.push_back(detector.detect());
    move_some(owned);
  }
  return result;
}

void expect_the_same_meetings(const Detector_options& options, bool computed = false) {
  const auto expected = frames_of_groups(options, 1, computed);
  EXPECT_TRUE(expected.front().collides());
  EXPECT_GT(expected.front().pairs.size(), 60U);
  for (const std::size_t threads : {2, 5}) {
    const auto found = frames_of_groups(options, threads, computed);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      expect_same_frame(found[i], expected[i]);
      EXPECT_EQ(found[i].statistics.vertices_read, expected[i].statistics.vertices_read);
    }
  }
}

constexpr std::array all_queries{Contact_query::yes_no, Contact_query::first, Contact_query::all};

TEST(Many_bodies_by_meetings, each_query_does_not_depend_on_threads) {
  for (const auto query : all_queries) expect_the_same_meetings({.contacts = query, .list_candidates = true});
}

/// The budget of a pair depends on what earlier pairs have read.
TEST(Many_bodies_by_meetings, searches_that_the_budget_ends_do_not_depend_on_threads) {
  for (const std::size_t budget : {0U, 40U, 200U})
    for (const auto query : all_queries)
      expect_the_same_meetings(
          {.opening_budget = budget, .contacts = query, .contact_points = query == Contact_query::all});
}

TEST(Many_bodies_by_meetings, positions_that_are_computed_are_read_by_one_thread) {
  for (const auto query : all_queries) expect_the_same_meetings({.contacts = query}, true);
}

TEST(Many_bodies_by_meetings, the_error_of_a_frame_does_not_depend_on_threads) {
  std::vector<std::string> messages;
  for (const std::size_t threads : {1, 2, 5}) {
    auto owned = groups_of_bodies();
    Detector<> detector({.mode = Mode::particles, .threads = threads});
    for (const auto& mesh : owned) detector.add(std::as_const(mesh));
    const Frame before = detector.detect();
    const auto whole = owned;
    for (const std::size_t object : {7, 12, 13})
      for (auto& p : owned[object].points()) p = Point(std::numeric_limits<double>::quiet_NaN(), p.y(), p.z());
    for (int again = 0; again < 2; ++again) {
      try {
        detector.detect();
        FAIL() << "no error";
      } catch (const Bad_mesh& error) {
        messages.emplace_back(error.what());
      }
    }
    for (const std::size_t object : {7, 12, 13})
      std::ranges::copy(whole[object].points(), owned[object].points().begin());
    EXPECT_EQ(detector.detect().face_pairs, before.face_pairs);
  }
  for (const auto& message : messages) EXPECT_EQ(message, messages.front());
}

}  // namespace
}  // namespace lodestone
