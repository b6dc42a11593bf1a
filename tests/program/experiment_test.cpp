// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "program/run_program.h"
#include "program/score.h"
#include "runner/experiments.h"
#include "shared/fit.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

constexpr Object_pair first_pair{0, 1}, second_pair{0, 2};

/// Truth and answer of one pair, a character per frame: `+` collides, `.` does not.
void add(Score& score, Object_pair pair, std::string_view truth, std::string_view answer) {
  ASSERT_EQ(truth.size(), answer.size());
  for (std::size_t i = 0; i < truth.size(); ++i) score.add(pair, truth[i] == '+', answer[i] == '+');
}

Score score_of(std::string_view truth, std::string_view answer) {
  Score score;
  add(score, first_pair, truth, answer);
  score.finish();
  return score;
}

TEST(Score, counts_frames_by_truth_and_answer) {
  const auto score = score_of("++++...", "++.+..+");
  EXPECT_EQ(score.frames(), 7U);
  EXPECT_EQ(score.positives(), 4U);
  EXPECT_EQ(score.false_negatives(), 1U);
  EXPECT_EQ(score.false_positives(), 1U);
  EXPECT_DOUBLE_EQ(score.recall(), 3.0 / 4);
  EXPECT_DOUBLE_EQ(score.precision(), 3.0 / 4);
  EXPECT_DOUBLE_EQ(score.accuracy(), 5.0 / 7);
}

TEST(Score, is_perfect_where_nothing_collides_and_nothing_is_reported) {
  for (const auto& score : {Score(), score_of("...", "...")}) {
    EXPECT_EQ(score.recall(), 1);
    EXPECT_EQ(score.precision(), 1);
    EXPECT_EQ(score.accuracy(), 1);
    EXPECT_EQ(score.collisions(), 0U);
    EXPECT_EQ(score.mean_delay(), 0);
  }
}

TEST(Score, the_delay_is_counted_from_the_start_of_each_collision) {
  const auto score = score_of(".++++..+++.++", "...++..+.+..+");
  EXPECT_EQ(score.collisions(), 3U);
  EXPECT_EQ(score.never_seen(), 0U);
  EXPECT_DOUBLE_EQ(score.mean_delay(), (2.0 + 0 + 1) / 3);
}

TEST(Score, a_collision_that_is_never_seen_has_no_delay) {
  const auto score = score_of("++.+++.++", ".+.....+.");
  EXPECT_EQ(score.collisions(), 3U);
  EXPECT_EQ(score.never_seen(), 1U);
  EXPECT_DOUBLE_EQ(score.mean_delay(), (1.0 + 0) / 2);
}

TEST(Score, a_false_positive_does_not_start_a_collision) {
  const auto score = score_of("...++", "+++.+");
  EXPECT_EQ(score.collisions(), 1U);
  EXPECT_DOUBLE_EQ(score.mean_delay(), 1);
  EXPECT_DOUBLE_EQ(score.precision(), 1.0 / 4);
}

TEST(Score, a_collision_at_the_end_counts_after_finish) {
  Score score;
  add(score, first_pair, ".++", "..+");
  EXPECT_EQ(score.collisions(), 0U);
  score.finish();
  score.finish();
  EXPECT_EQ(score.collisions(), 1U);
  EXPECT_DOUBLE_EQ(score.mean_delay(), 1);
}

TEST(Score, collisions_of_different_pairs_are_separate) {
  Score score;
  const std::string_view truth_1 = "+++.", answer_1 = "..+.", truth_2 = ".+++", answer_2 = "....";
  for (std::size_t i = 0; i < truth_1.size(); ++i) {
    add(score, first_pair, truth_1.substr(i, 1), answer_1.substr(i, 1));
    add(score, second_pair, truth_2.substr(i, 1), answer_2.substr(i, 1));
  }
  score.finish();
  EXPECT_EQ(score.frames(), 8U);
  EXPECT_EQ(score.positives(), 6U);
  EXPECT_EQ(score.collisions(), 2U);
  EXPECT_EQ(score.never_seen(), 1U);
  EXPECT_DOUBLE_EQ(score.mean_delay(), 2);
  EXPECT_DOUBLE_EQ(score.recall(), 1.0 / 6);
}

TEST(Score, finished_scores_add_up) {
  auto sum = score_of("++..", ".+.+");
  sum.add(score_of("+++.++", "...+++"));
  EXPECT_EQ(sum.frames(), 10U);
  EXPECT_EQ(sum.positives(), 7U);
  EXPECT_EQ(sum.false_positives(), 2U);
  EXPECT_EQ(sum.false_negatives(), 4U);
  EXPECT_EQ(sum.collisions(), 3U);
  EXPECT_EQ(sum.never_seen(), 1U);
  EXPECT_DOUBLE_EQ(sum.mean_delay(), (1.0 + 0) / 2);
}

TEST(Fitted_exponent, equals_that_of_a_power_law) {
  const std::vector<double> x{1, 2, 5, 17, 1000, 1e6};
  for (const double exponent : {-2.0, -0.5, 0.0, 1.0, 1.5, 3.0})
    for (const double factor : {1e-6, 1.0, 42.0}) {
      std::vector<double> y;
      y.reserve(x.size());
      for (const double value : x) y.push_back(factor * std::pow(value, exponent));
      EXPECT_NEAR(fitted_exponent(x, y), exponent, 1e-12);
    }
}

TEST(Fitted_exponent, of_two_points_is_the_slope_of_their_logarithms) {
  EXPECT_NEAR(fitted_exponent(std::array{2.0, 8.0}, std::array{3.0, 24.0}), std::log(8) / std::log(4), 1e-14);
}

TEST(Fitted_exponent, balances_errors_to_both_sides) {
  // In logarithms: (0, 0), (1, 1 + d), (2, 2 - 2 d), (3, 3 + d). The errors have no part along the line or its level.
  const double d = 0.3;
  const std::array x{1.0, std::exp(1.0), std::exp(2.0), std::exp(3.0)};
  const std::array y{1.0, std::exp(1 + d), std::exp(2 - 2 * d), std::exp(3 + d)};
  // Least squares by hand: sum of (t - 1.5) e over sum of (t - 1.5)^2.
  EXPECT_NEAR(fitted_exponent(x, y), 1 + (-0.5 * d + 0.5 * -2 * d + 1.5 * d) / 5, 1e-12);
}

class Experiment_program : public testing::Test {
 protected:
  /// Three frames instead of the experiment's three hundred.
  void SetUp() override {
    folder.write("teapot_sphere_1.json", R"({"frames": 3, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 5}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 0, "at": [2.5, 0, 0]}, {"frame": 2, "at": [1.6, 0, 0]}]}}]}}]})");
  }
  Program_result run(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"experiment", "collision_distance", "--scenes", folder.path().string(),
                                       "--out",      out.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Experiment_program, writes_its_figures_and_its_report) {
  const auto result = run({});
  expect_success(result);
  EXPECT_EQ(content_of(out), (std::set<std::string>{"collision_distance.json", "collision_distance.md"}));
  const auto figures = read_json(out / "collision_distance.json");
  ASSERT_FALSE(figures.empty());
  for (const auto& figure : figures) {
    EXPECT_EQ(figure["frames"], 3);
    EXPECT_EQ(figure["positive"], 1);  // unit spheres 2.5, 2.05 and 1.6 apart
    EXPECT_EQ(figure["precision"], 1.0);
  }
  const auto report = read_bytes(out / "collision_distance.md");
  EXPECT_NE(report.find("| recall |"), std::string::npos) << report;
  EXPECT_NE(result.out.find(report), std::string::npos);
  EXPECT_TRUE(result.out.starts_with("Why is mu ")) << result.out;
}

TEST_F(Experiment_program, quiet_prints_nothing) {
  const auto result = run({"--quiet"});
  expect_success(result);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(content_of(out).size(), 2U);
}

TEST_F(Experiment_program, refuses_a_folder_without_its_scenes) {
  remove(folder.path() / "teapot_sphere_1.json");
  expect_error(run({}), 3, "teapot_sphere_1.json");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Experiment_program, refuses_an_experiment_that_does_not_exist) {
  expect_error(run_program({"experiment", "alchemy", "--out", out.string()}), 2, "alchemy");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Experiment_program, refuses_an_output_folder_that_is_a_file) {
  folder.write("out", "mine");
  expect_error(run({}), 4, "out");
  EXPECT_EQ(read_bytes(out), "mine");
}

TEST(Experiments, have_a_name_and_a_question_each) {
  std::set<std::string_view> names;
  for (const auto& experiment : experiments()) {
    EXPECT_TRUE(names.insert(experiment.name).second);
    EXPECT_TRUE(experiment.question.ends_with('?'));
  }
}

TEST(Experiments, without_scenes_refuse_a_folder_of_scenes_and_name_those_that_read_one) {
  const Temporary_folder folder;
  for (const auto& experiment : experiments()) {
    if (std::ranges::find(experiment.options, "--scenes") != experiment.options.end()) continue;
    SCOPED_TRACE(experiment.name);
    const auto result = run_program({"experiment", std::string(experiment.name), "--scenes", folder.path().string(),
                                     "--out", (folder.path() / "out").string()});
    expect_error(result, 2, "ignores --scenes, which is for teapot_sphere, scaling, ");
    EXPECT_EQ(content_of(folder.path()), std::set<std::string>{});
  }
}

TEST(Experiments, that_read_scenes_refuse_a_folder_that_does_not_exist) {
  const Temporary_folder folder;
  for (const auto& experiment : experiments()) {
    if (std::ranges::find(experiment.options, "--scenes") == experiment.options.end()) continue;
    SCOPED_TRACE(experiment.name);
    const auto none = (folder.path() / "none").string();
    const auto result = run_program(
        {"experiment", std::string(experiment.name), "--scenes", none, "--out", (folder.path() / "out").string()});
    expect_error(result, 3, none + ": there is no such folder of scenes");
    EXPECT_EQ(content_of(folder.path()), std::set<std::string>{});
  }
}

TEST(Experiments, are_named_in_the_help_of_each_option_that_they_read) {
  const auto help = run_program({"experiment", "--help"});
  expect_success(help);
  for (const auto& experiment : experiments())
    for (const auto option : experiment.options) {
      if (option == "--merge-shards") continue;  // not in the help: lodestone merge gives it
      const auto begin = help.out.find("\n  " + std::string(option) + ' ');
      ASSERT_NE(begin, std::string::npos) << option;
      const auto end = help.out.find("\n  -", begin + 1);
      EXPECT_NE(help.out.substr(begin, end - begin).find(experiment.name), std::string::npos)
          << option << ' ' << experiment.name;
    }
}

TEST(Experiment_command, states_how_to_build_the_experiments_if_they_are_missing) {
  const Temporary_folder folder;
  const auto alone = folder.path() / "lodestone";
  std::filesystem::copy_file(LODESTONE_PROGRAM, alone);
  expect_error(run_program({"experiment", "modes"}, {.program = alone.string()}), 2,
               "'scripts/build release lodestone_experiments' builds them");
}

}  // namespace
}  // namespace lodestone::test
