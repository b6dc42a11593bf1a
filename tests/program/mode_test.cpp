// SPDX-License-Identifier: GPL-3.0-or-later
// Which mode answers, and what the program says about a mode that may miss collisions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "program/run_program.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream row(line);
  for (std::string cell; std::getline(row, cell, '|');) {
    const auto begin = cell.find_first_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin));
  }
  return cells;
}

/// The least and the most that a method missed in the published table of an experiment: one minus the recall.
/// @param method   how the cell of a row with the method begins
/// @param columns  of recalls, counted from that cell
/// @param but      how the cell of a row of another method begins
std::pair<double, double> missed_share(const std::string& experiment, const std::string& method,
                                       const std::vector<std::ptrdiff_t>& columns, const std::string& but = {}) {
  std::pair<double, double> share{1, 0};
  std::istringstream report(read_bytes(LODESTONE_TESTS "/../experiments/" + experiment + "/README.md"));
  for (std::string line; std::getline(report, line);) {
    const auto cells = cells_of(line);
    const auto at = std::ranges::find_if(cells, [&](const auto& cell) { return cell.starts_with(method); });
    // Other tables are narrower.
    if (cells.size() < 10 || at == cells.end() || (!but.empty() && at->starts_with(but))) continue;
    for (const auto column : columns) {
      const double missed = 1 - std::stod(at[column]);
      share = {std::min(share.first, missed), std::max(share.second, missed)};
    }
  }
  return share;
}

/// A square, and a triangle that cuts it far from all its vertices.
class Program_mode : public testing::Test {
 protected:
  Program_result detect(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"detect", folder.write("square.off", square_off).string(),
                                       folder.write("needle.off", needle_off).string(), "--out", out.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
  Json summary() const { return read_json(out / "summary.json"); }
  Json frame() const { return read_json_lines(out / "frames.jsonl").at(0); }

  static constexpr const char* needle_off = "OFF\n3 1 0\n0.7 0.2 -1\n0.7 0.2 1\n0.8 0.2 1\n3 0 1 2\n";
  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Program_mode, is_the_one_that_misses_nothing_unless_another_is_named) {
  const auto result = detect({});
  expect_success(result);
  EXPECT_EQ(frame()["pairs"].at(0)["collides"], true);
  EXPECT_EQ(summary()["mode"], "exact");
  EXPECT_EQ(summary()["may_miss"], nullptr);
  EXPECT_EQ(summary()["strategy"], nullptr);  // nothing is divided
  EXPECT_EQ(result.out.find("may miss"), std::string::npos) << result.out;
  expect_success(detect({"--mode", "particles", "--meetings", "0", "--collision-distance", "0.001"}));
  EXPECT_EQ(frame()["pairs"].at(0)["collides"], false);
  EXPECT_EQ(summary()["strategy"], "lbg");
}

TEST_F(Program_mode, that_may_miss_collisions_says_so_with_the_published_figures) {
  struct Published {
    std::vector<std::string> options;
    std::pair<double, double> share;
  };
  // Without figures to tell apart, one word says it.
  const auto with_meetings = missed_share("modes", "particles, ", {1}, "particles, no meetings");
  EXPECT_EQ(with_meetings, std::pair(0.0, 0.0));
  const auto found_all = detect({"--mode", "particles"});
  EXPECT_NE(found_all.out.find("missed none of the colliding frames"), std::string::npos) << found_all.out;

  const std::vector<Published> published{
      {{"--mode", "particles", "--meetings", "0"}, missed_share("modes", "particles, no meetings, ", {1})},
      {{"--mode", "senin"}, missed_share("predecessor", "scattered", {3, 4})}};
  for (const auto& [options, share] : published) {
    SCOPED_TRACE(testing::PrintToString(options));
    const auto result = detect(options);
    expect_success(result);
    EXPECT_NE(result.out.find("Mode " + options[1] + " may miss collisions"), std::string::npos) << result.out;
    const auto figures =
        fmt::format("missed {:.0f} to {:.0f} % of the colliding frames", 100 * share.first, 100 * share.second);
    EXPECT_NE(result.out.find(figures), std::string::npos) << figures << " in:\n" << result.out;
    const Json may_miss = summary()["may_miss"];
    EXPECT_NEAR(may_miss["least_share"].get<double>(), share.first, 0.005);
    EXPECT_NEAR(may_miss["most_share"].get<double>(), share.second, 0.005);
    auto quiet = options;
    quiet.emplace_back("--quiet");
    EXPECT_EQ(detect(quiet).out.find("may miss"), std::string::npos);
  }
}

TEST_F(Program_mode, that_may_miss_more_than_was_measured_tells_no_figures) {
  const std::vector<std::vector<std::string>> unmeasured{{"--opening-reach", "0.5"},
                                                         {"--opening-budget", "100"},
                                                         {"--meetings", "1"},
                                                         {"--particles", "4"},
                                                         {"--meetings", "0", "--collision-distance", "0.1"},
                                                         {"--growth", "9"},
                                                         {"--strategy", "grid"},
                                                         {"--normal-weight", "0"},
                                                         {"--split", "multiplicative"},
                                                         {"--epsilon", "0.1"},
                                                         {"--lbg-tolerance", "0.1"},
                                                         {"--lbg-sample", "0"},
                                                         {"--keep-islands"},
                                                         {"--open-seams"}};
  for (auto options : unmeasured) {
    SCOPED_TRACE(testing::PrintToString(options));
    options.insert(options.begin(), {"--mode", "particles"});
    const auto result = detect(options);
    expect_success(result);
    EXPECT_NE(result.out.find("has not measured how many"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find(" of the colliding frames"), std::string::npos) << result.out;
    EXPECT_EQ(summary()["may_miss"],
              Json({{"least_share", nullptr}, {"most_share", nullptr}, {"experiment", nullptr}}));
  }
}

TEST_F(Program_mode, that_may_miss_tells_figures_unless_an_object_asks_for_fewer_particles) {
  const auto note = [&](const std::string& particles, const std::vector<std::string>& options) {
    const auto scene = folder.write("scene.json", R"({"name": "two spheres", "objects": [
          {"name": "a", "shape": {"icosphere": {"frequency": 4}})" +
                                                      particles + R"(},
          {"name": "b", "shape": {"icosphere": {"frequency": 4}}, "particles": 40}]})");
    std::vector<std::string> arguments{"detect", scene.string(), "--mode", "particles"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto result = run_program(arguments);
    expect_success(result);
    return result.out;
  };
  const std::string figures = "of the colliding frames", none = "has not measured how many";
  EXPECT_NE(note("", {}).find(figures), std::string::npos);
  EXPECT_NE(note(R"(, "particles": 12)", {}).find(figures), std::string::npos);
  EXPECT_NE(note(R"(, "particles": 11)", {}).find(none), std::string::npos);
  EXPECT_NE(note(R"(, "particles": 11)", {"--particles", "12"}).find(figures), std::string::npos);
}

TEST_F(Program_mode, exact_refuses_the_options_of_particles) {
  const std::map<std::string, std::string> options{{"--meetings", "0"},
                                                   {"--opening-budget", "100"},
                                                   {"--opening-reach", "0.5"},
                                                   {"--collision-distance", "9"},
                                                   {"--candidates", "closest"},
                                                   {"--growth", "inf"},
                                                   {"--distance-measure", "all_vertices"}};
  for (const auto& [option, value] : options) {
    SCOPED_TRACE(option);
    expect_error(detect({option, value}), 2, "mode particles");
    expect_error(detect({option, value, "--mode", "exact"}), 2, "mode particles");
    const bool published =
        option == "--collision-distance" || option == "--candidates" || option == "--distance-measure";
    expect_success(detect({option, value, "--mode", "particles", published ? "--meetings=0" : "--quiet"}));
  }
}

TEST_F(Program_mode, senin_refuses_the_options_of_meetings) {
  for (const auto* option : {"--meetings", "--opening-budget", "--opening-reach"})
    expect_error(detect({"--mode", "senin", option, "3"}), 2, std::string(option) + " needs --mode particles");
}

TEST_F(Program_mode, particles_with_meetings_refuse_what_only_the_published_method_uses) {
  for (const auto& [option, value] : {std::pair("--collision-distance", "9"), std::pair("--candidates", "closest"),
                                      std::pair("--distance-measure", "all_vertices")}) {
    expect_error(detect({"--mode", "particles", option, value}), 2, "add --meetings 0");
    expect_success(detect({"--mode", "particles", "--meetings", "0", option, value}));
  }
}

TEST_F(Program_mode, the_published_distance_measure_is_longer_than_a_mean_edge) {
  // A tiny triangle in the middle of a face of the cloth, two hundredths from its nearest vertex. A tenth of the mean
  // edge is five thousandths, a tenth of the mean distance of vertices is ten times that.
  const auto tiny = folder.write("tiny.off",
                                 "OFF\n3 1 0\n0.0167 0.0333 -0.005\n0.0167 0.0333 0.005\n0.0177 0.0333 0.005\n"
                                 "3 0 1 2\n");
  const auto collides = [&](const std::string& measure) {
    expect_success(run_program({"detect", R"(shape:{"cloth": {"columns": 20, "rows": 20}})", tiny.string(), "--out",
                                out.string(), "--mode", "particles", "--meetings", "0", "--collision-distance", "0.1",
                                "--distance-measure", measure}));
    return frame()["pairs"].at(0)["collides"].get<bool>();
  };
  EXPECT_TRUE(collides("all_vertices"));
  EXPECT_FALSE(collides("adjacent_vertices"));
  expect_error(detect({"--mode", "particles", "--meetings", "0", "--distance-measure", "edges"}), 2,
               "adjacent_vertices");
}

TEST_F(Program_mode, particles_find_a_needle_far_from_all_vertices_by_meetings_and_may_miss_it_without) {
  for (const auto* budget : {"1000", "16384"}) {
    expect_success(detect({"--mode", "particles", "--opening-budget", budget}));
    EXPECT_EQ(frame()["pairs"].at(0)["collides"], true);
    EXPECT_EQ(frame()["statistics"]["leaf_tests"], 1);
  }
  expect_success(detect({"--mode", "particles", "--meetings", "0", "--collision-distance", "0.001"}));
  EXPECT_EQ(frame()["pairs"].at(0)["collides"], false);
  EXPECT_EQ(frame()["statistics"]["meetings"], 0);
  EXPECT_EQ(frame()["statistics"]["leaf_tests"], 0);
}

TEST_F(Program_mode, limits_of_particles_out_of_range_are_refused) {
  for (const auto* bad : {"0", "-1", "inf", "nan", "much"})
    expect_error(detect({"--mode", "particles", "--opening-reach", bad}), 2, "");
  for (const auto* option : {"--meetings", "--opening-budget", "--most-contacts"})
    for (const auto* bad : {"-1", "1.5", "many"}) expect_error(detect({"--mode", "particles", option, bad}), 2, "");
}

TEST_F(Program_mode, senin_takes_threads) {
  expect_success(detect({"--mode", "senin", "--threads", "2"}));
  expect_success(detect({"--mode", "particles", "--threads", "2"}));
}

TEST_F(Program_mode, options_of_other_strategies_are_refused) {
  const std::map<std::string, std::string> options{{"--normal-weight", "0.5"},
                                                   {"--split", "multiplicative"},
                                                   {"--epsilon", "0.01"},
                                                   {"--lbg-tolerance", "0.01"},
                                                   {"--lbg-sample", "0"}};
  for (const auto& [option, value] : options) {
    SCOPED_TRACE(option);
    const auto needs = option + " needs --strategy lbg";
    expect_error(detect({option, value, "--strategy", "grid"}), 2, needs);
    expect_error(
        run_program({"partition", (folder.path() / "square.off").string(), option, value, "--strategy", "grid"}), 2,
        needs);
    expect_success(detect({option, value, "--strategy", "lbg"}));
  }
  expect_error(detect({"--split", "multiplicative", "--strategy", "kmeans++"}), 2, "the strategy kmeans++ ignores it");
  expect_error(detect({"--normal-weight", "1", "--strategy", "lbg_position"}), 2, "--normal-weight");
  expect_success(detect({"--normal-weight", "1", "--strategy", "kmeans++"}));
}

TEST_F(Program_mode, islands_are_kept_where_there_are_regions) {
  expect_error(detect({"--mode", "senin", "--keep-islands"}), 2, "--keep-islands needs --mode exact");
  for (const auto* mode : {"particles", "exact", "certified"}) {
    expect_success(detect({"--mode", mode, "--keep-islands"}));
    EXPECT_EQ(summary()["strategy"], "lbg") << mode;
  }
}

TEST_F(Program_mode, threads_share_frames_whatever_the_strategy) {
  expect_success(detect({"--threads", "2", "--strategy", "grid", "--mode", "particles"}));
  expect_success(detect({"--threads", "2", "--strategy", "grid"}));
}

TEST_F(Program_mode, threads_are_refused_where_the_strategy_alone_would_use_them_and_does_not) {
  const auto square = folder.write("square.off", square_off).string();
  expect_error(run_program({"partition", square, "--threads", "2", "--strategy", "grid"}), 2, "--threads");
  expect_success(run_program({"partition", square, "--threads", "2"}));
}

TEST_F(Program_mode, tells_the_time_to_build_apart_from_that_of_a_frame) {
  for (const auto* mode : {"particles", "senin", "exact"}) {
    SCOPED_TRACE(mode);
    const auto result = detect({"--mode", mode});
    expect_success(result);
    EXPECT_NE(result.out.find("microseconds per frame (median, all stages but build)"), std::string::npos);
    EXPECT_NE(result.out.find("milliseconds to build 2 objects"), std::string::npos) << result.out;
    EXPECT_GT(summary()["build_microseconds"], 0);
    const Json median = summary()["median_microseconds"];
    double sum = 0;
    for (const auto& [stage, time] : median.items()) sum += stage == "without_build" ? 0 : time.get<double>();
    EXPECT_NEAR(median["without_build"].get<double>(), sum, 1e-6 * sum);
    EXPECT_EQ(frame()["statistics"]["builds"], 2);
  }
}

TEST_F(Program_mode, exact_takes_particles_as_regions) {
  expect_success(detect({"--particles", "2"}));
  EXPECT_EQ(summary()["mode"], "exact");
  EXPECT_EQ(frame()["pairs"].at(0)["collides"], true);
}

}  // namespace
}  // namespace lodestone::test
