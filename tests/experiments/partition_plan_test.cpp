// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/partition_plan.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "lodestone/detector.h"
#include "lodestone/mesh/errors.h"
#include "partitions/partition_report.h"
#include "partitions/partition_run.h"

namespace lodestone {
namespace {

TEST(Partition_plan, is_the_full_cross_product_with_an_id_for_each_run) {
  const auto plan = partition_plan();
  std::set<std::string> ids, variants, meshes;
  for (const auto& run : plan) {
    EXPECT_TRUE(ids.insert(run.id()).second) << run.id();
    variants.insert(run.variant.name);
    meshes.insert(std::string(run.mesh.name));
    EXPECT_EQ(run.variant.settings.seed, run.seed);
  }
  EXPECT_EQ(meshes.size(), 8U);
  EXPECT_EQ(variants.size(), partition_variants().size());
  for (const auto& entry : strategies()) EXPECT_TRUE(variants.contains(std::string(entry.name))) << entry.name;
  std::size_t large_enough = 0;
  for (const auto& entry : strategies()) large_enough += entry.most_vertices > 20'000 ? 1 : 0;
  EXPECT_GE(plan.size(), large_enough * meshes.size() * 5 * 5);
}

TEST(Partition_plan, keeps_only_the_named_runs) {
  const auto plan = partition_plan({"cloth_coarse", "lbg", "lbg_position"});
  EXPECT_EQ(plan.size(), 2U * 5 * 5);
  for (const auto& run : plan) EXPECT_EQ(run.mesh.name, "cloth_coarse");
  EXPECT_THROW(partition_plan({"cloth"}), Bad_argument);
}

TEST(Partition_plan, meshes_have_about_2000_and_10000_triangles) {
  for (const auto& mesh : partition_meshes()) {
    const double wanted = mesh.name.ends_with("coarse") ? 2000 : 10000;
    EXPECT_NEAR(static_cast<double>(mesh.make().number_of_faces()), wanted, 0.13 * wanted) << mesh.name;
  }
}

TEST(Partition_scene, surfaces_meet_in_some_frames_and_not_in_others_for_any_seed) {
  for (const auto& mesh : partition_meshes()) {
    if (!mesh.name.ends_with("coarse")) continue;
    for (const auto seed : partition_seeds) {
      Scene scene = partition_scene(mesh, seed);
      Detector<> detector({.mode = Mode::exact});
      for (const auto& object : scene.objects) detector.add(object.mesh);
      std::size_t positive = 0;
      for (std::size_t frame = 0; frame < scene.frames; ++frame) {
        for (auto& object : scene.objects) pose(object, frame);
        positive += detector.detect().collides() ? 1 : 0;
      }
      EXPECT_GE(positive, scene.frames / 10) << mesh.name << ' ' << seed;
      EXPECT_LE(positive, scene.frames * 2 / 3) << mesh.name << ' ' << seed;
    }
  }
}

TEST(Partition_run, repeats_the_same_row_except_for_times_and_memory) {
  const auto plan = partition_plan({"cloth_coarse", "lbg"});
  auto row = execute(plan[7]), again = execute(plan[7]);
  for (const char* key :
       {"seconds", "lbg_seconds", "peak_kib", "frame_us", "lbg_frame_us", "mean_frame_us", "lbg_mean_frame_us",
        "met_frame_us", "met_lbg_frame_us", "met_mean_frame_us", "met_lbg_mean_frame_us"}) {
    EXPECT_GE(row.at(key), 0) << key;
    row.erase(key);
    again.erase(key);
  }
  EXPECT_EQ(row, again);
  EXPECT_EQ(row["regions_wanted"], 12);
  EXPECT_EQ(row["seed"], 3);
  EXPECT_EQ(row["precision"], 1.0);
  EXPECT_GT(row["positive"], 0);
  EXPECT_GT(row["recall"], 0.5);
  EXPECT_EQ(row["met_precision"], 1.0);
  EXPECT_GE(row["met_recall"], row["recall"]);
}

TEST(Partition_report, has_tables_of_meetings_unless_rows_of_earlier_revisions_lack_them) {
  std::map<std::string, nlohmann::ordered_json> rows;
  auto row = execute(partition_plan({"cloth_coarse", "lbg"})[0]);
  row["regions_wanted"] = 32;
  row["met_recall"] = 0.75;
  rows["new"] = row;
  const auto report = partition_report(rows);
  const auto section = report.find("## In use with meetings, 32 particles per object");
  ASSERT_NE(section, std::string::npos) << report;
  EXPECT_NE(report.find("| lbg      |      1 |  0.750 |", section), std::string::npos) << report;
  row.erase("met_recall");
  row["seed"] = 99;
  rows["old"] = row;
  EXPECT_EQ(partition_report(rows).find("with meetings"), std::string::npos);
}

TEST(Partition_report, averages_over_meshes_first_and_then_over_seeds) {
  std::map<std::string, nlohmann::ordered_json> rows;
  const auto full = execute(partition_plan({"cloth_coarse", "lbg"})[0]);
  // Recall by mesh and seed: seed 1 has 0.2 and 0.4, seed 2 has 0.6 and 1: means 0.3 and 0.8.
  const auto add = [&](const char* mesh, int seed, double recall) {
    auto row = full;
    row["mesh"] = mesh;
    row["seed"] = seed;
    row["recall"] = recall;
    row["regions_wanted"] = 32;
    rows[std::string(mesh) + std::to_string(seed)] = row;
  };
  add("cloth_coarse", 1, 0.2);
  add("sphere_fine", 1, 0.4);
  add("cloth_coarse", 2, 0.6);
  add("sphere_fine", 2, 1.0);
  const auto figures = partition_figures(rows);
  std::size_t found = 0;
  for (const auto& figure : figures) {
    if (figure["figure"] != "recall") continue;
    ++found;
    const double mean = figure["mesh"] == "all" ? 0.55 : figure["mesh"] == "cloth_coarse" ? 0.4 : 0.7;
    EXPECT_NEAR(figure["mean"], mean, 1e-12);
    if (figure["mesh"] == "all") {
      EXPECT_GE(figure["low"], 0);
      EXPECT_LT(figure["low"], mean);
      EXPECT_LE(figure["high"], 1);
      EXPECT_GT(figure["high"], mean);
    }
  }
  EXPECT_EQ(found, 3U);
  EXPECT_NE(partition_report(rows).find("| lbg      |      2 | 0.550 (0."), std::string::npos)
      << partition_report(rows);
}

TEST(Partition_report, compares_recall_with_that_of_lbg_in_the_same_scene) {
  std::map<std::string, nlohmann::ordered_json> rows;
  auto row = execute(partition_plan({"cloth_coarse", "lbg"})[0]);
  row["regions_wanted"] = 32;
  // Scenes differ by 0.5, the strategies in one scene by 0.125.
  for (const int seed : {1, 2})
    for (const char* variant : {"lbg", "metis"}) {
      row["seed"] = seed;
      row["variant"] = variant;
      row["recall"] = 0.5 * (seed - 1) + (row["variant"] == "metis" ? 0.125 : 0);
      rows[std::string(variant) + std::to_string(seed)] = row;
    }
  const auto report = partition_report(rows);
  const auto table = report.substr(report.find("Difference from the recall of `lbg`"));
  const auto line =
      table.substr(table.find("| metis"), table.find('\n', table.find("| metis")) - table.find("| metis"));
  EXPECT_NE(line.find(" 0.125 |"), std::string::npos) << line;
  EXPECT_EQ(line.find(".."), std::string::npos) << line;
}

}  // namespace
}  // namespace lodestone
