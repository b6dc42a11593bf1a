// SPDX-License-Identifier: GPL-3.0-or-later
#include "first_answer/first_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "lodestone/queries/exhaustive.h"
#include "peers/peer.h"

namespace lodestone {
namespace {

std::vector<Point> positions_of_second(const Once_scene& scene) {
  return {scene.b.points().begin(), scene.b.points().end()};
}

TEST(First_answer, scenes_collide_where_their_names_say_so) {
  for (const auto& kind : once_kinds()) {
    const Once_scene scene = make_once_scene(kind, once_sizes().front());
    const bool apart = kind.name == "far" || kind.name == "beside" || kind.name == "inside";
    EXPECT_EQ(exhaustive_face_pairs(scene.a, scene.b).empty(), apart) << kind.name;
    EXPECT_EQ(scene.a.number_of_faces(), scene.triangles);
  }
}

TEST(First_answer, contestants_that_decide_exactly_are_right_at_once_and_in_the_next_frame) {
  for (const auto& kind : once_kinds())
    for (const auto& contestant : once_contestants()) {
      if (contestant.library == "Bullet" || contestant.library == "ODE" || contestant.library == "FCL") continue;
      SCOPED_TRACE(kind.name + ", " + contestant.name());
      Once_scene scene = make_once_scene(kind, once_sizes().front());
      const auto yes_no = contestant.begin(scene.a, scene.b, Contact_query::yes_no);
      const auto pairs = contestant.begin(scene.a, scene.b, Contact_query::all);
      for (int frame = 0; frame < 2; ++frame) {
        const auto truth = exhaustive_face_pairs(scene.a, scene.b);
        EXPECT_EQ(yes_no->any(), !truth.empty());
        std::vector<Face_pair> found;
        if (contestant.reports_pairs) {
          pairs->all(found);
          std::ranges::sort(found);
          EXPECT_EQ(found, truth);
        }
        scene.step();
        yes_no->update(), pairs->update();
      }
    }
}

TEST(First_answer, contestants_are_one_call_a_detector_and_every_library) {
  const auto all = once_contestants();
  const auto has = [&](const std::string& name) { return std::ranges::count(all, name, &Once_contestant::name) == 1; };
  EXPECT_EQ(all.front().name(), "Lodestone: find_collisions");
  for (const char* name : {"Lodestone: Detector", "CGAL: PMP::do_intersect", "CGAL: box_intersection_d, overlap only",
                           "Embree: rebuild", "Embree: rebuild, high quality", "ODE: OPCODE, refit"})
    EXPECT_TRUE(has(name)) << name;
}

TEST(First_answer, a_build_pays_from_the_frame_in_which_it_has_caught_up) {
  const Once_times calls{.first = 10, .frame = 10};
  EXPECT_EQ(pays_from({.first = 8, .frame = 20}, calls), 1U);
  EXPECT_EQ(pays_from({.first = 55, .frame = 1}, calls), 6U);  // 55 + 5 = 60
  EXPECT_EQ(pays_from({.first = 56, .frame = 1}, calls), 7U);
  EXPECT_EQ(pays_from({.first = 11, .frame = 10}, calls), std::nullopt);
  const Once_times warm{.first = 10, .frame = 3};             // a call whose data the caches still hold
  EXPECT_EQ(pays_from({.first = 20, .frame = 1}, warm), 6U);  // 20 + 5 = 10 + 5 * 3
  EXPECT_EQ(pays_from({.first = 20, .frame = 5}, warm), std::nullopt);
  EXPECT_EQ((Once_times{.first = 5, .frame = 2}.of_frames(10)), 23);
}

TEST(First_answer, is_asked_at_each_size_once_and_at_the_smallest_first) {
  const auto& sizes = once_sizes();
  const auto ordered = in_order({sizes[1], sizes[0], sizes[1]});
  ASSERT_EQ(ordered.size(), 2U);
  EXPECT_EQ(ordered[0].triangles(), sizes[0].triangles());
  EXPECT_EQ(ordered[1].triangles(), sizes[1].triangles());
}

/// Waits before it answers no: so many milliseconds at least in its first answers, one after the other.
class Slow_session : public Session {
 public:
  explicit Slow_session(double milliseconds, int frames) : milliseconds_(milliseconds), frames_(frames) {}
  void update() override {
    milliseconds_ = 0;
    if (--frames_ < 0) throw Gave_up();
  }
  bool any() override {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds_));
    return false;
  }
  void all(std::vector<Face_pair>&) override {}

 private:
  double milliseconds_;
  int frames_;
};

/// A contestant that reports no face pairs. It answers in so many more frames, then it gives up.
/// @param begun  its name is added whenever a session begins
Once_contestant slow_contestant(const std::string& name, std::vector<double> milliseconds,
                                std::vector<std::string>& begun, int frames = 1000) {
  return {.library = name,
          .method = "",
          .reports_pairs = false,
          .begin = [=, &begun, round = std::size_t{0}](const Surface_mesh&, const Surface_mesh&,
                                                       Contact_query) mutable -> std::unique_ptr<Session> {
            begun.push_back(name);
            return std::make_unique<Slow_session>(milliseconds[round++ % milliseconds.size()], frames);
          }};
}

TEST(First_answer, contestants_follow_each_other_in_changing_order) {
  std::vector<std::string> begun;
  std::vector<Once_contestant> three;
  for (const char* name : {"a", "b", "c"}) three.push_back(slow_contestant(name, {0}, begun));
  Once_scene scene = make_once_scene(once_kinds()[0], once_sizes().front());
  measure_first_answers(scene, three, {false, false, false}, 2);
  // One session each for the peak of memory, then two rounds of the question yes or no.
  EXPECT_EQ(begun, (std::vector<std::string>{"a", "b", "c", "a", "b", "c", "b", "a", "c"}));
}

TEST(First_answer, a_time_is_the_median_of_all_rounds) {
  std::vector<std::string> begun;
  const std::vector<Once_contestant> one{slow_contestant("a", {0, 30, 0, 30}, begun)};  // the first for the peak
  Once_scene scene = make_once_scene(once_kinds()[0], once_sizes().front());
  const auto figures = measure_first_answers(scene, one, {false}, 3);
  ASSERT_TRUE(figures[0].any);
  EXPECT_GE(figures[0].any->first, 0.03);  // of 30, 0 and 30 milliseconds
  EXPECT_FALSE(figures[0].all);
}

TEST(First_answer, rounds_in_which_a_contestant_gives_up_do_not_count) {
  std::vector<std::string> begun;
  const std::vector<Once_contestant> one{slow_contestant("a", {0}, begun, 2)};
  Once_scene scene = make_once_scene(once_kinds()[0], once_sizes().front());
  const auto before = positions_of_second(scene);
  const auto figures = measure_first_answers(scene, one, {false}, 3);
  EXPECT_TRUE(figures[0].gave_up);
  EXPECT_FALSE(figures[0].any);
  EXPECT_EQ(begun.size(), 2U);
  EXPECT_EQ(positions_of_second(scene), before);
}

/// Says that two meshes collide once they have moved.
class Late_liar : public Session {
 public:
  void update() override { collides_ = true; }
  bool any() override { return collides_; }
  void all(std::vector<Face_pair>&) override {}

 private:
  bool collides_ = false;
};

TEST(First_answer, compares_the_answers_of_later_frames_too) {
  std::vector<std::string> begun;
  const Once_contestant liar{
      .library = "liar", .reports_pairs = false, .begin = [](const Surface_mesh&, const Surface_mesh&, Contact_query) {
        return std::make_unique<Late_liar>();
      }};
  Once_scene far = make_once_scene(once_kinds()[0], once_sizes().front());
  ASSERT_EQ(once_kinds()[0].name, "far");
  const std::vector<Once_contestant> both{liar, slow_contestant("honest", {0}, begun)};
  const auto figures = measure_first_answers(far, both, {false, false}, 1);
  EXPECT_FALSE(figures[0].right);
  EXPECT_TRUE(figures[1].right);
}

TEST(First_answer, measures_every_question_that_a_contestant_answers) {
  const auto all = once_contestants();
  Once_scene scene = make_once_scene(once_kinds()[2], once_sizes().front());
  const auto before = positions_of_second(scene);
  std::vector<bool> left_out(all.size(), false);
  left_out.back() = true;
  const auto figures = measure_first_answers(scene, all, left_out, 2);
  ASSERT_EQ(figures.size(), all.size());
  for (const auto& f : figures) {
    SCOPED_TRACE(f.contestant->name());
    EXPECT_EQ(f.left_out, f.contestant == &all.back());
    if (f.left_out || f.gave_up) continue;
    ASSERT_TRUE(f.any);
    EXPECT_GT(f.any->first, 0);
    EXPECT_GT(f.any->frame, 0);
    EXPECT_EQ(f.all.has_value(), f.contestant->reports_pairs);
  }
  EXPECT_TRUE(figures[0].right);
  EXPECT_TRUE(figures[1].right);
  EXPECT_EQ(positions_of_second(scene), before);
}

}  // namespace
}  // namespace lodestone
