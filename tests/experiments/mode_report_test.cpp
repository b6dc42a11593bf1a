// SPDX-License-Identifier: GPL-3.0-or-later
#include "modes/mode_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lodestone {
namespace {

/// Figures of a setting that finds `found` of `positives` colliding frames in each of three plays.
Mode_figures figures_of(const std::string& scene, const std::string& setting, std::size_t found, std::size_t positives,
                        std::size_t invented = 0) {
  Mode_figures figures{.scene = scene,
                       .triangles = 320,
                       .measurement = {.setting = {.name = setting, .options = {.mode = Mode::particles}}},
                       .face_pairs = {.found = 1, .all = 4},
                       .exact_median = 1};
  auto& m = figures.measurement;
  for (int play = 0; play < 3; ++play) {
    Score score;
    for (std::size_t i = 0; i < positives; ++i) score.add({0, 1}, true, i < found);
    for (std::size_t i = 0; i < invented; ++i) score.add({0, 1}, false, true);
    score.finish();
    m.score.add(score);
    m.recalls.push_back(score.recall());
  }
  return figures;
}

/// Whether one line of a table has these parts in this order.
bool has_line(const std::string& table, const std::vector<std::string>& parts) {
  for (std::size_t begin = 0, end; (end = table.find('\n', begin)) != table.npos; begin = end + 1) {
    const std::string line = table.substr(begin, end - begin);
    std::size_t at = 0;
    bool all = true;
    for (const auto& part : parts) {
      at = line.find(part, at);
      if (at == line.npos) {
        all = false;
        break;
      }
      at += part.size();
    }
    if (all) return true;
  }
  return false;
}

TEST(Mode_report, recall_is_the_mean_over_the_plays_with_wilson_s_interval_of_all_their_frames) {
  // All plays find all: of n successes in n trials Wilson's interval is [n / (n + t^2), 1], with t = 4.303.
  const auto interval = recall_interval(figures_of("a", "particles, 12", 100, 100));
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->mean, 1);
  EXPECT_NEAR(interval->low, 300 / (300 + 4.303 * 4.303), 1e-4);
  const auto half = recall_interval(figures_of("a", "particles, 12", 50, 100));
  EXPECT_DOUBLE_EQ(half->mean, 0.5);
}

TEST(Mode_report, the_truth_and_a_scene_without_collisions_have_no_recall) {
  auto truth = figures_of("a", "exact", 3, 3);
  truth.is_truth = true;
  EXPECT_FALSE(recall_interval(truth));
  EXPECT_FALSE(recall_interval(figures_of("a", "particles, 12", 0, 0)));
  EXPECT_FALSE(to_json(truth).contains("recall_low"));
}

TEST(Mode_report, shows_the_recall_of_frames_with_its_interval_and_that_of_face_pairs) {
  const std::vector<Mode_figures> rows{figures_of("a", "particles, 12", 100, 100)};
  EXPECT_TRUE(has_line(table_of_scenes(rows), {"| a ", "320", "particles, 12", "1.000 [0.942, 1.000]", "0.250"}))
      << table_of_scenes(rows);
}

TEST(Mode_report, the_mode_exact_has_no_recall_of_face_pairs_because_it_is_their_truth) {
  std::vector<Mode_figures> rows{figures_of("a", "exact", 1, 1)};
  rows[0].measurement.setting.options.mode = Mode::exact;
  EXPECT_EQ(table_of_scenes(rows).find("0.250"), std::string::npos) << table_of_scenes(rows);
}

TEST(Mode_report, sums_up_each_setting_over_the_scenes_in_which_something_collides) {
  const std::vector<Mode_figures> rows{
      figures_of("a", "particles, 12", 9, 10),    figures_of("a", "particles, 32", 10, 10),
      figures_of("b", "particles, 12", 7, 10, 4), figures_of("b", "particles, 32", 10, 10),
      figures_of("still", "particles, 12", 0, 0), figures_of("still", "particles, 32", 0, 0)};
  const auto table = table_of_settings(rows);
  // 3 x 16 true and 3 x 4 false positives.
  EXPECT_TRUE(has_line(table, {"particles, 12", "2", "0.800", "0.700", "b", "0.250", "0.250", "0.800"})) << table;
  EXPECT_TRUE(has_line(table, {"particles, 32", "2", "1.000", "1.000", "-", "0.250", "0.250", "1.000"})) << table;
}

TEST(Mode_report, figures_name_the_method_that_a_curve_joins) {
  EXPECT_EQ(to_json(figures_of("a", "particles, 12", 1, 1))["method"], "particles");
  EXPECT_EQ(to_json(figures_of("a", "particles, far, 12", 1, 1))["method"], "particles, far");
  EXPECT_EQ(to_json(figures_of("a", "exact", 1, 1))["method"], "exact");
}

}  // namespace
}  // namespace lodestone
