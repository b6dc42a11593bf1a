// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/certified_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"
#include "program/measurement.h"
#include "shared/fit.h"
#include "shared/race_figures.h"

namespace lodestone {

namespace {

/// How many times as much the one reads as the other, in the median frames.
std::string times_less(const std::vector<double>& all, const std::vector<double>& some) {
  return median(some) > 0 ? fmt::format("{:.2f}", median(all) / median(some)) : "reads nothing";
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }

using Seconds = std::vector<double> Rival_figures::*;

const Rival_figures& certified_of(const Character_figures& figures) { return figures.rivals[0]; }
const Rival_figures& exact_of(const Character_figures& figures) { return figures.rivals[1]; }

/// The library with the least median whose answers are right; null: none took part, or none is right.
const Rival_figures* fastest_library(const Character_figures& figures, Seconds question) {
  const Rival_figures* best = nullptr;
  for (const auto& rival : figures.rivals)
    if (rival.is_library && rival.is_right() && !(rival.*question).empty() &&
        (best == nullptr || median(rival.*question) < median(best->*question)))
      best = &rival;
  return best;
}

/// How many times as long another takes as mode `certified`.
double median_ratio(const Character_figures& figures, const Rival_figures& other, Seconds question) {
  return median(other.*question) / median(certified_of(figures).*question);
}
double mean_ratio(const Character_figures& figures, const Rival_figures& other, Seconds question) {
  return mean(other.*question) / mean(certified_of(figures).*question);
}

std::string answers_of(const Rival_figures& rival) {
  if (rival.gave_up) return "gave up";
  return fmt::format("{} / {} / {}", rival.missed, rival.invented, rival.wrong_sets);
}

std::string ratio_row(const Character_figures& figures) {
  std::string text;
  for (const auto& [question, name] : {std::pair<Seconds, const char*>(&Rival_figures::any_seconds, "yes/no"),
                                       {&Rival_figures::all_seconds, "all pairs"}}) {
    text += fmt::format(
        "- {}: posing everything + exact takes {:.2f} times as long in the median frame, {:.2f} times in "
        "the mean",
        name, median_ratio(figures, exact_of(figures), question), mean_ratio(figures, exact_of(figures), question));
    if (const auto* library = fastest_library(figures, question))
      text += fmt::format("; the fastest library that is right ({}) {:.1f} times in the median frame", library->name,
                          median_ratio(figures, *library, question));
    text += ".\n";
  }
  return text;
}

}  // namespace

std::string section(const Character_figures& figures) {
  Text_table table(
      {"method", "yes/no (ms)", "mean", "p95", "all pairs (ms)", "mean", "p95", "missed / false / wrong sets"});
  for (const auto& rival : figures.rivals) {
    std::vector<std::string> row{rival.name};
    for (const auto& seconds : {rival.any_seconds, rival.all_seconds}) {
      row.push_back(seconds.empty() ? "-" : milliseconds(median(seconds)));
      row.push_back(seconds.empty() ? "-" : milliseconds(mean(seconds)));
      row.push_back(seconds.empty() ? "-" : milliseconds(percentile_95(seconds)));
    }
    row.push_back(answers_of(rival));
    table.add(row);
  }
  const auto& counts = figures.certified;
  return fmt::format(
      "## {}, {} triangles\n\n{} vertices, {:.1f} joints per vertex. {} frames, of which {} collide. Posing everything "
      "takes {} ms. In the median frame mode `certified` reads {} of the vertices for yes or no and {} for all pairs, "
      "and bounds {:.0f} nodes; {} of the faces are near, and {} touch, at most {}. Boxes from bounds are {:.2f} times "
      "as large as fitted ones. Broken bounds: {}.\n\n{}\n{}",
      figures.scene, figures.triangles, figures.vertices, figures.influences, figures.frames.size(), figures.colliding,
      milliseconds(figures.pose_seconds), percent(median(counts.any_read)), percent(median(counts.all_read)),
      median(counts.nodes_bounded), percent(median(counts.near_faces)), percent(median(counts.touching_faces)),
      percent(std::ranges::max(counts.touching_faces)), counts.tightness, counts.violations, table.text(),
      ratio_row(figures));
}

std::string summary(std::span<const Character_figures> figures) {
  std::map<std::size_t, std::vector<const Character_figures*>> sizes;
  std::map<std::string, std::array<std::vector<double>, 2>> growth;
  for (const auto& f : figures) {
    if (f.everything_is_near) continue;
    sizes[f.size].push_back(&f);
    growth[f.scene][0].push_back(static_cast<double>(f.triangles));
    growth[f.scene][1].push_back(median(certified_of(f).any_seconds));
  }
  if (sizes.empty()) return "";
  Text_table table({"triangles, nearly", "scenes", "yes/no (ms)", "exact over certified", "library over certified",
                    "all pairs, mean: exact over certified", "library over certified", "read for yes/no"});
  for (const auto& [size, scenes] : sizes) {
    std::vector<double> any, any_library, all, all_library, seconds, read;
    for (const auto* f : scenes) {
      seconds.push_back(median(certified_of(*f).any_seconds));
      read.push_back(median(f->certified.any_read));
      any.push_back(median_ratio(*f, exact_of(*f), &Rival_figures::any_seconds));
      all.push_back(mean_ratio(*f, exact_of(*f), &Rival_figures::all_seconds));
      if (const auto* library = fastest_library(*f, &Rival_figures::any_seconds))
        any_library.push_back(median_ratio(*f, *library, &Rival_figures::any_seconds));
      if (const auto* library = fastest_library(*f, &Rival_figures::all_seconds))
        all_library.push_back(mean_ratio(*f, *library, &Rival_figures::all_seconds));
    }
    const auto ratio = [](const std::vector<double>& values) {
      return values.empty() ? "-" : fmt::format("{:.1f}", median(values));
    };
    table.add({std::to_string(size), std::to_string(scenes.size()), milliseconds(median(seconds)), ratio(any),
               ratio(any_library), ratio(all), ratio(all_library), percent(median(read))});
  }
  std::string text = "## All characters\n\nMedians over the scenes, but for that in which everything is near.\n\n" +
                     table.text() + "\n";
  for (const auto& [scene, points] : growth)
    if (points[0].size() > 1)
      text += fmt::format("- {}: the median frame of yes or no grows with the power {:.2f} of the triangles.\n", scene,
                          fitted_exponent(points[0], points[1]));
  return text;
}

std::string table(std::span<const Promise_figures> figures) {
  Text_table table({"scene", "triangles", "promise", "exact reads so many times as much: yes/no", "reads: all pairs",
                    "exact takes so many times as long: yes/no", "time: all pairs, mean", "yes/no (ms)",
                    "all pairs, mean (ms)", "wrong answers", "wrong sets", "broken"});
  for (const auto& f : figures) {
    const auto add = [&](const Promise_row& row) {
      const Promise_row& exact = exact_beside(row, f);
      table.add({f.scene, std::to_string(f.triangles), row.promise, times_less(exact.any_read, row.any_read),
                 times_less(exact.all_read, row.all_read), times_less(exact.any_seconds, row.any_seconds),
                 fmt::format("{:.2f}", mean(exact.all_seconds) / mean(row.all_seconds)),
                 milliseconds(median(row.any_seconds)), milliseconds(mean(row.all_seconds)),
                 std::to_string(row.wrong_answers), std::to_string(row.wrong_sets), std::to_string(row.violations)});
    };
    add(f.exact);
    add(f.posed_and_exact);
    for (const auto& row : f.rows) add(row);
  }
  return "## Scenes with promises\n\nMedian frames; for the time of all pairs the mean.\n\n" + table.text();
}

nlohmann::ordered_json to_json(const Character_figures& figures) {
  const auto& counts = figures.certified;
  nlohmann::ordered_json json{{"scene", figures.scene},
                              {"size", figures.size},
                              {"triangles", figures.triangles},
                              {"vertices", figures.vertices},
                              {"joints_per_vertex", figures.influences},
                              {"everything_is_near", figures.everything_is_near},
                              {"frames", figures.frames},
                              {"colliding", figures.colliding},
                              {"pose_s", figures.pose_seconds},
                              {"read_yes_no", counts.any_read},
                              {"read_all_pairs", counts.all_read},
                              {"nodes_bounded", counts.nodes_bounded},
                              {"near_faces", counts.near_faces},
                              {"touching_faces", counts.touching_faces},
                              {"tightness", counts.tightness},
                              {"broken", counts.violations}};
  for (const auto& rival : figures.rivals) {
    nlohmann::ordered_json entry{{"method", rival.name},
                                 {"library", rival.is_library},
                                 {"yes_no_median_ms", 1e3 * median(rival.any_seconds)},
                                 {"yes_no_s", rival.any_seconds},
                                 {"missed", rival.missed},
                                 {"invented", rival.invented},
                                 {"gave_up", rival.gave_up}};
    if (!rival.all_seconds.empty()) {
      entry["all_pairs_mean_ms"] = 1e3 * mean(rival.all_seconds);
      entry["all_pairs_s"] = rival.all_seconds;
      entry["wrong_sets"] = rival.wrong_sets;
    }
    json["entries"].push_back(std::move(entry));
  }
  return json;
}

nlohmann::ordered_json to_json(const Promise_figures& figures) {
  const auto row_json = [](const Promise_row& row) -> nlohmann::ordered_json {
    return {{"promise", row.promise},
            {"yes_no_read_median", median(row.any_read)},
            {"all_pairs_read_median", median(row.all_read)},
            {"yes_no_median_ms", 1e3 * median(row.any_seconds)},
            {"all_pairs_mean_ms", 1e3 * mean(row.all_seconds)},
            {"yes_no_read", row.any_read},
            {"all_pairs_read", row.all_read},
            {"wrong_answers", row.wrong_answers},
            {"wrong_sets", row.wrong_sets},
            {"broken", row.violations}};
  };
  nlohmann::ordered_json json{{"scene", figures.scene},
                              {"triangles", figures.triangles},
                              {"vertices", figures.vertices},
                              {"frames", figures.frames},
                              {"colliding", figures.colliding},
                              {"exact", row_json(figures.exact)},
                              {"posed_and_exact", row_json(figures.posed_and_exact)}};
  for (const auto& row : figures.rows) json["promises"].push_back(row_json(row));
  return json;
}

}  // namespace lodestone
