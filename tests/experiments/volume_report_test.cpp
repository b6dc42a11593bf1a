// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of the experiment `volumes`, from figures that make the expected values simple.
#include "volumes/volume_report.h"

#include <gtest/gtest.h>

#include <regex>

namespace lodestone {
namespace {

Frame_seconds milliseconds_of(double update, double any, double all) {
  return {1e-3 * update, 1e-3 * any, 1e-3 * all, 1e-3 * (update + any), 1e-3 * (update + all)};
}

void add(Volume_scene& scene, Contestant contestant, const Frame_seconds& seconds) {
  Entry_figures figures{.entry = contestant.entry, .passes = 2, .frames = {seconds}};
  figures.missed = contestant.kind == Contestant_kind::particles ? 1 : 0;
  scene.race.entries.push_back(figures);
  scene.contestants.push_back(std::move(contestant));
}

void add_volume(Volume_scene& scene, const char* model, std::string_view strategy, const Frame_seconds& seconds,
                const Tightness& tightness) {
  const Volume_figures figures{.node_bytes = 24,
                               .nodes = 9,
                               .frames = 2,
                               .volume_tests = 40,
                               .leaf_pairs = 20,
                               .exact_tests = 6,
                               .first = {1, 1, 1, 1},
                               .last = tightness};
  add(scene,
      {.kind = Contestant_kind::volume,
       .model = model,
       .strategy = std::string(strategy),
       .entry = {.library = "Lodestone", .method = std::string(strategy), .volume = model, .build = nullptr},
       .figures = std::make_shared<Volume_figures>(figures)},
      seconds);
}

/// Boxes take 1 for the update, 2 for yes or no and 3 for all pairs, balls 4, 5 and 6, all of it twice over regions by
/// another strategy than lbg; 32 particles 0.5 and 1 in the median frame, 2 in the mean one.
Volume_scene simple_scene() {
  Volume_scene scene;
  scene.race = {.name = "tiny", .objects = 2, .triangles = 10, .vertices = 8, .frames = 5, .sampled = {3}};
  scene.race.asked = 4;
  scene.race.colliding = 3;
  for (const auto strategy : dividing_strategies()) {
    const double times = strategy == reference_strategy ? 1 : 2;
    add_volume(scene, "aabb", strategy, milliseconds_of(times, 2 * times, 3 * times), {2, 3, 4, 5});
    add_volume(scene, "ball", strategy, milliseconds_of(4 * times, 5 * times, 6 * times), {6, 7, 8, 9});
    scene.divisions.push_back({std::string(strategy), 0.5});
  }
  add(scene,
      {.kind = Contestant_kind::particles,
       .model = std::string(reference_particles),
       .strategy = std::string(reference_strategy),
       .entry = {.library = "Lodestone",
                 .method = "particles, 32",
                 .volume = "none",
                 .reports_pairs = false,
                 .build = nullptr},
       .particles =
           std::make_shared<Particle_figures>(Particle_figures{.frames = 4, .seconds = 8e-3, .repartitions = 1})},
      milliseconds_of(0.5, 1, 0));
  return scene;
}

/// The report with single spaces.
std::string report_of(const Volume_scene& scene) {
  return std::regex_replace(volume_report(std::span(&scene, 1)), std::regex(" +"), " ");
}

/// The first row of a table, after its title and two header lines.
std::string line_after(const std::string& report, const std::string& title, int line) {
  auto place = report.find(title);
  if (place == std::string::npos) return "there is no " + title;
  for (int skipped = 0; skipped < line + 4; ++skipped) place = report.find('\n', place) + 1;
  return report.substr(place, report.find('\n', place) - place);
}

TEST(Volume_report, compares_volumes_with_boxes_and_particles) {
  const auto report = report_of(simple_scene());
  EXPECT_EQ(line_after(report, "Update, in times of aabb:", 0), "| tiny | 10 | 1.00 | 4.00 |");
  EXPECT_EQ(line_after(report, "Update + yes/no, in times of aabb:", 0), "| tiny | 10 | 1.00 | 3.00 |");
  EXPECT_EQ(line_after(report, "Update + all pairs, in times of aabb:", 0), "| tiny | 10 | 1.00 | 2.50 |");
  EXPECT_EQ(line_after(report, "Share of the update in update + all pairs:", 0), "| tiny | 10 | 0.25 | 0.40 |");
  EXPECT_EQ(line_after(report, "in times of the median frame of 32 particles", 0), "| tiny | 10 | 2.00 | 6.00 |");
  EXPECT_EQ(line_after(report, "in times of their mean frame", 0), "| tiny | 10 | 1.50 | 4.50 |");
  EXPECT_EQ(line_after(report, "Particles: median frame", 0), "| tiny | 10 | 0.50 / 0.67 / 25 / 2 of 3 |");
}

TEST(Volume_report, compares_strategies_with_lbg) {
  const auto report = report_of(simple_scene());
  EXPECT_EQ(line_after(report, "Update by strategy", 0), "| lbg | 1.00 | 1.00 |");
  EXPECT_EQ(line_after(report, "Update by strategy", 3), "| vsa | 2.00 | 2.00 |");
  EXPECT_EQ(line_after(report, "Query for all pairs by strategy", 2), "| median_split | 2.00 | 2.00 |");
  EXPECT_EQ(line_after(report, "Tightness of leaves in", 0), "| lbg | 2.00 | 6.00 |");
  EXPECT_EQ(line_after(report, "Tightness of regions in", 0), "| lbg | 3.00 | 7.00 |");
  EXPECT_EQ(line_after(report, "Tightness of regions refitted in", 0), "| lbg | 4.00 | 8.00 |");
  EXPECT_EQ(line_after(report, "Tightness of objects in", 0), "| lbg | 5.00 | 9.00 |");
}

TEST(Volume_report, has_every_figure_of_every_contestant) {
  const auto report = report_of(simple_scene());
  EXPECT_EQ(
      line_after(report, "Per frame:", 3),
      "| ball | lbg_position | 8.000 | 8.00 | 10.00 | 18.00 | 6.00 | 12.0 | 12.00 | 20.00 | 5.00 | 20 | 10 | 3 | 0 "
      "| 24 | 2 |");
  EXPECT_EQ(
      line_after(report, "Per frame:", 8),
      "| particles, 32 | lbg | 0.5000 | 0.50 | 1.000 | 1.500 | 0.50 | 1.00 | - | - | - | - | - | - | 2 of 3 | - | 2 "
      "|");
  EXPECT_EQ(line_after(report, "Tightness in the first / last sampled frame", 1),
            "| lbg | regions | 1.00 / 3.00 | 1.00 / 7.00 |");
}

TEST(Volume_report, gives_no_ratio_for_contestants_that_stopped_early_and_says_so) {
  auto scene = simple_scene();
  auto& ball = scene.race.entries[1];
  ball.left_early = true;
  scene.race.batches = 2;
  const auto report = report_of(scene);
  EXPECT_EQ(line_after(report, "Update, in times of aabb:", 0), "| tiny | 10 | 1.00 | - |");
  EXPECT_NE(report.find("(ball) played 1 of the 1 frames"), std::string::npos);
  EXPECT_NE(report.find("one of 2 groups at a time"), std::string::npos);
}

}  // namespace
}  // namespace lodestone
