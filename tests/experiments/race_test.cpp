// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/race.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <random>

#include "lodestone/io/scenes/scene_file.h"
#include "shared/read_bound.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

TEST(Read_every_vertex, gives_the_bounding_box_for_any_number_of_points) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-3, 5);
  for (const std::size_t points : {1, 2, 7, 8, 9, 16, 23, 1000}) {
    std::vector<double> coordinates(3 * points);
    Box box;
    for (std::size_t p = 0; p < points; ++p) {
      for (std::size_t axis = 0; axis < 3; ++axis) coordinates[3 * p + axis] = coordinate(random);
      box.extend(Eigen::Map<Eigen::Vector3d>(&coordinates[3 * p]));
    }
    EXPECT_EQ(read_every_vertex(coordinates).min(), box.min()) << points;
    EXPECT_EQ(read_every_vertex(coordinates).max(), box.max()) << points;
  }
  EXPECT_TRUE(read_every_vertex({}).isEmpty());
}

TEST(Spread, samples_the_middles_of_equal_parts) {
  EXPECT_EQ(spread(100, 2), (std::vector<std::size_t>{25, 75}));
  EXPECT_EQ(spread(10, 1), std::vector<std::size_t>{5});
  EXPECT_EQ(spread(3, 8), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(spread(0, 5).empty());
}

TEST(Index_of, finds_a_pair_and_gives_the_number_of_pairs_for_one_that_was_not_asked_for) {
  const std::vector<Object_pair> pairs{{0, 1}, {0, 2}, {1, 2}};
  EXPECT_EQ(index_of({0, 2}, pairs), 1U);
  EXPECT_EQ(index_of({2, 1}, pairs), pairs.size());
  EXPECT_EQ(index_of({0, 1}, {}), 0U);
}

/// Gives prescribed answers.
class Liar : public Entrant {
 public:
  explicit Liar(Answer answer) : answer_(std::move(answer)) {}
  const Answer& play(std::span<const Object_pair> pairs) override {
    answer_.collides.resize(pairs.size(), answer_.collides.at(0));
    answer_.contacts.resize(pairs.size(), answer_.contacts.at(0));
    return answer_;
  }

 private:
  Answer answer_;
};

Entry liar(const Answer& answer) {
  return {.library = "test", .method = "lie", .volume = "none", .build = [answer](std::span<const Moving_mesh>) {
            return std::make_unique<Liar>(answer);
          }};
}

class Race : public testing::Test {
 protected:
  /// Two unit spheres: far apart in frames 0 to 2, near in 3, intersecting in 4 and 5.
  void SetUp() override {
    const auto file = folder_.write("two.json", R"({"frames": 6, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 5}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 2, "at": [3, 1, 1]}, {"frame": 3, "at": [1.5, 1.5, 1]},
                                          {"frame": 4, "at": [1.5, 0, 0]}]}}]}}]})");
    scene_ = read_scene(file);
  }
  Scene_figures measured(const Entry& entry, const Race_options& options = {}) {
    return measure_race(scene_, std::vector{entry}, options, [](double) {});
  }

  test::Temporary_folder folder_;
  Scene scene_;
};

TEST_F(Race, plays_the_frames_in_which_the_boxes_overlap) {
  const auto figures = measured(liar({.collides = {true}, .contacts = {{}}}));
  EXPECT_EQ(figures.sampled, (std::vector<std::size_t>{3, 4, 5}));
  EXPECT_EQ(figures.asked, 3U);
  EXPECT_EQ(figures.colliding, 2U);
}

TEST_F(Race, counts_missed_and_invented_collisions) {
  const auto yes = measured(liar({.collides = {true}, .contacts = {{}}})).entries.at(0);
  EXPECT_EQ(yes.missed, 0U);
  EXPECT_EQ(yes.invented, 1U);
  EXPECT_EQ(yes.wrong_sets, 2U);
  EXPECT_EQ(yes.false_pairs, 0U);
  EXPECT_GT(yes.missing_pairs, 0U);
  EXPECT_FALSE(yes.any_is_right());
  const auto no = measured(liar({.collides = {false}, .contacts = {{{9999, 9999}, {9999, 9999}}}})).entries.at(0);
  EXPECT_EQ(no.missed, 2U);
  EXPECT_EQ(no.invented, 0U);
  EXPECT_EQ(no.wrong_sets, 3U);
  EXPECT_EQ(no.false_pairs, 3U);
  EXPECT_FALSE(no.any_is_right());
}

/// Answers yes or no in one round, and lists contacts (none) in the next.
class One_by_one : public Entrant {
 public:
  explicit One_by_one(std::vector<std::size_t>& rounds) : rounds_(rounds) {}
  std::size_t rounds() const override { return 2; }
  void start_round(std::size_t round) override { rounds_.push_back(round); }
  const Answer& play(std::span<const Object_pair> pairs) override {
    constexpr double not_asked = std::numeric_limits<double>::infinity();
    const bool lists = rounds_.back() == 1;
    answer_.update_seconds = lists ? 0.5 : 0.25;
    answer_.any_seconds = lists ? not_asked : 1;
    answer_.all_seconds = lists ? 2 : not_asked;
    answer_.collides.assign(pairs.size(), !lists);
    answer_.contacts.assign(pairs.size(), {});
    return answer_;
  }

 private:
  std::vector<std::size_t>& rounds_;
  Answer answer_;
};

/// The entry of a contestant that records the rounds it starts.
template <class Kind>
Entry entry_of(std::vector<std::size_t>& rounds) {
  return {.library = "test", .method = "rounds", .volume = "none", .build = [&rounds](std::span<const Moving_mesh>) {
            return std::make_unique<Kind>(rounds);
          }};
}

TEST_F(Race, a_contestant_that_answers_in_rounds_is_checked_for_the_question_of_each_round) {
  std::vector<std::size_t> rounds;
  const auto entry = measured(entry_of<One_by_one>(rounds), {.passes = 2}).entries.at(0);
  EXPECT_EQ(rounds, (std::vector<std::size_t>{0, 1, 0, 1}));
  EXPECT_EQ(entry.passes, 6U);  // of three frames
  EXPECT_EQ(entry.missed, 0U);
  EXPECT_EQ(entry.invented, 1U);
  EXPECT_EQ(entry.wrong_sets, 2U);
  EXPECT_EQ(entry.wrong_later, 0U);
  EXPECT_EQ(entry.frames.at(0).update, 0.25);
  EXPECT_EQ(entry.frames.at(0).update_and_any, 1.25);
  EXPECT_EQ(entry.frames.at(0).update_and_all, 2.5);
}

TEST_F(Race, collisions_of_pairs_whose_boxes_are_apart_count_as_invented) {
  const auto entry = measured(liar({.collides = {true}, .elsewhere = 2, .contacts = {{}}})).entries.at(0);
  EXPECT_EQ(entry.invented, 1U + 3 * 2U);  // one in frame 3, two in each of three frames
  EXPECT_FALSE(entry.any_is_right());
}

/// Reports its memory.
class Counts_bytes : public One_by_one {
 public:
  using One_by_one::One_by_one;
  std::optional<std::size_t> bytes() const override { return 12345; }
};

TEST_F(Race, a_contestant_that_reports_its_memory_is_believed) {
  std::vector<std::size_t> rounds;
  const auto entry = measured(entry_of<Counts_bytes>(rounds)).entries.at(0);
  EXPECT_EQ(entry.bytes, 12345U);
}

TEST_F(Race, figures_are_the_minimum_over_the_passes) {
  const auto figures = measured(
      liar({.update_seconds = 0.5, .any_seconds = 0.25, .all_seconds = 2, .collides = {true}, .contacts = {{}}}),
      {.passes = 4});
  const auto& entry = figures.entries.at(0);
  EXPECT_EQ(entry.passes, 12U);
  ASSERT_EQ(entry.frames.size(), 3U);
  EXPECT_EQ(entry.frames[0].update_and_any, 0.75);
  EXPECT_EQ(entry.frames[0].update_and_all, 2.5);
}

TEST_F(Race, a_contestant_that_gives_up_is_never_right_and_plays_no_further_frame) {
  const auto entry = measured(liar({.gave_up = true, .collides = {true}, .contacts = {{}}})).entries.at(0);
  EXPECT_TRUE(entry.gave_up);
  EXPECT_EQ(entry.frames.size(), 1U);
  EXPECT_EQ(entry.passes, 1U);
  EXPECT_EQ(entry.invented, 0U);
  EXPECT_FALSE(entry.any_is_right());
}

TEST_F(Race, a_contestant_out_of_time_stops_early) {
  const auto entry =
      measured(liar({.collides = {true}, .contacts = {{}}}), {.passes = 1, .most_seconds = 0}).entries[0];
  EXPECT_TRUE(entry.left_early);
  EXPECT_EQ(entry.frames.size(), 1U);
  EXPECT_FALSE(entry.any_is_right());
}

/// Records the height of the first vertex of the second object in every call.
class Witness : public Entrant {
 public:
  struct Seen {
    std::vector<double> approached, played;
    std::vector<std::size_t> inspected, pairs;
  };
  Witness(const Moving_mesh& mesh, Seen& seen) : mesh_(mesh), seen_(seen) {}
  bool wants_approach() const override { return true; }
  void approach() override { seen_.approached.push_back(mesh_.points()[0].y()); }
  const Answer& play(std::span<const Object_pair> pairs) override {
    seen_.played.push_back(mesh_.points()[0].y());
    answer_.collides.assign(pairs.size(), true);
    answer_.contacts.resize(pairs.size());
    return answer_;
  }
  void inspect(std::span<const Object_pair> pairs, std::size_t frame, std::size_t frames) override {
    EXPECT_EQ(frames, 2U);
    EXPECT_EQ(mesh_.points()[0].y(), seen_.played[frame]);
    seen_.inspected.push_back(frame);
    seen_.pairs.push_back(pairs.size());
  }

 private:
  Moving_mesh mesh_;
  Seen& seen_;
  Answer answer_;
};

TEST_F(Race, frames_up_to_the_last_sampled_one_are_played_in_order_and_sampled_ones_inspected_at_the_end) {
  Witness::Seen seen;
  measured({.library = "test",
            .method = "see",
            .volume = "none",
            .build = [&](std::span<const Moving_mesh> meshes) { return std::make_unique<Witness>(meshes[1], seen); }},
           {.least_frames = 2, .most_frames = 2, .passes = 2});
  // Frames 3 and 5 are sampled, at y = 1.5 and 0; frames 0, 1, 2 and 4 come before, at 1, 1, 1 and 0.
  ASSERT_EQ(seen.played.size(), 4U);
  const double base = seen.played[1];
  const auto at = [&](std::vector<double> heights) {
    for (double& height : heights) height += base;
    return heights;
  };
  EXPECT_EQ(seen.played, at({1.5, 0, 1.5, 0}));
  EXPECT_EQ(seen.approached, at({1, 1, 1, 0, 1, 1, 1, 0}));
  EXPECT_EQ(seen.inspected, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(seen.pairs, (std::vector<std::size_t>{1, 1}));
}

TEST_F(Race, a_contestant_slow_between_sampled_frames_plays_no_second_pass) {
  Witness::Seen seen;
  measured({.library = "test",
            .method = "see",
            .volume = "none",
            .build = [&](std::span<const Moving_mesh> meshes) { return std::make_unique<Witness>(meshes[1], seen); }},
           {.least_frames = 2, .most_frames = 2, .passes = 2, .approach_seconds = 0});
  EXPECT_EQ(seen.played.size(), 2U);
}

}  // namespace
}  // namespace lodestone
