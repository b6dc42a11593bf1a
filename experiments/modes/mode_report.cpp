// SPDX-License-Identifier: GPL-3.0-or-later
#include "modes/mode_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"

namespace lodestone {

namespace {

constexpr const char* not_measured = "-";

bool is_exact(const Mode_figures& figures) { return figures.measurement.setting.options.mode == Mode::exact; }

std::string recall_text(const Mode_figures& figures) {
  const auto recall = recall_interval(figures);
  if (!recall) return not_measured;
  if (figures.measurement.recalls.size() < 2) return fmt::format("{:.3f}", recall->mean);  // no spread is known
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", recall->mean, recall->low, recall->high);
}

std::string face_pair_text(const Mode_figures& figures) {
  const auto [found, all] = figures.face_pairs;
  if (is_exact(figures) || all == 0) return not_measured;
  return fmt::format("{:.3f}", static_cast<double>(found) / static_cast<double>(all));
}

/// Positions that a frame reads, in percent of all vertices.
double percent_read(const Mode_figures& figures) {
  const double read = mean_count(figures.measurement, &Frame_statistics::vertices_read);
  return figures.vertices > 0 ? 100 * read / static_cast<double>(figures.vertices) : 0;
}

/// What the curve of the plot joins: settings that differ only in the number of particles.
std::string method_of(const Setting& setting) { return setting.name.substr(0, setting.name.rfind(',')); }

/// One setting over all scenes.
struct Setting_summary {
  std::string setting;
  Score score = {};
  double recalls = 0;      ///< their sum
  std::size_t scenes = 0;  ///< with a recall
  double least_recall = 1;
  std::string least_scene = not_measured;
  double face_pairs = 0;             ///< sum of the shares that were found
  std::size_t face_pair_scenes = 0;  ///< in which there are any
  double least_face_pairs = 1;

  void add(const Mode_figures& figures) {
    score.add(figures.measurement.score);
    if (const auto [found, all] = figures.face_pairs; !is_exact(figures) && all > 0) {
      const double share = static_cast<double>(found) / static_cast<double>(all);
      face_pairs += share;
      ++face_pair_scenes;
      least_face_pairs = std::min(least_face_pairs, share);
    }
    const auto recall = recall_interval(figures);
    if (!recall) return;
    recalls += recall->mean;
    if (scenes++ > 0 && recall->mean >= least_recall) return;
    least_recall = recall->mean;
    least_scene = figures.scene;
  }
};

/// In the order of the first scene.
std::vector<Setting_summary> summaries(std::span<const Mode_figures> rows) {
  std::vector<Setting_summary> all;
  for (const auto& row : rows) {
    const auto& name = row.measurement.setting.name;
    auto found = std::ranges::find(all, name, &Setting_summary::setting);
    if (found == all.end()) found = all.insert(all.end(), {.setting = name});
    found->add(row);
  }
  return all;
}

}  // namespace

std::optional<Interval> recall_interval(const Mode_figures& figures) {
  const auto& m = figures.measurement;
  if (figures.is_truth || m.score.positives() == 0) return std::nullopt;
  return proportion_interval(m.recalls, static_cast<double>(m.score.positives()));
}

std::string table_of_scenes(std::span<const Mode_figures> rows) {
  Text_table table({"scene", "triangles", "mode", "recall", "face pairs", "delay (frames)", "median (us)", "mean (us)",
                    "exact / this (median)", "read"});
  for (const auto& row : rows) {
    const auto& m = row.measurement;
    const double median = median_microseconds_without_build(m);
    const bool judged = recall_interval(row).has_value();
    table.add({row.scene, std::to_string(row.triangles), m.setting.name, recall_text(row), face_pair_text(row),
               judged ? fmt::format("{:.1f}", m.score.mean_delay()) : not_measured, fmt::format("{:.1f}", median),
               fmt::format("{:.1f}", mean_microseconds_without_build(m)),
               fmt::format("{:.2f}", row.exact_median / median), fmt::format("{:.1f} %", percent_read(row))});
  }
  return table.text();
}

std::string table_of_settings(std::span<const Mode_figures> rows) {
  Text_table table({"mode", "scenes", "mean recall", "least recall", "in scene", "mean face pairs", "least face pairs",
                    "precision"});
  for (const auto& summary : summaries(rows)) {
    const auto text = [](double share, std::size_t scenes) {
      return scenes > 0 ? fmt::format("{:.3f}", share) : std::string(not_measured);
    };
    const auto mean = [&](double sum, std::size_t scenes) { return text(sum / static_cast<double>(scenes), scenes); };
    table.add(
        {summary.setting, std::to_string(summary.scenes), mean(summary.recalls, summary.scenes),
         text(summary.least_recall, summary.scenes), summary.least_recall < 1 ? summary.least_scene : not_measured,
         mean(summary.face_pairs, summary.face_pair_scenes), text(summary.least_face_pairs, summary.face_pair_scenes),
         fmt::format("{:.3f}", summary.score.precision())});
  }
  return table.text();
}

nlohmann::ordered_json to_json(const Mode_figures& figures) {
  auto json = to_json(figures.measurement);
  json["scene"] = figures.scene;
  json["triangles"] = figures.triangles;
  json["vertices"] = figures.vertices;
  json["method"] = method_of(figures.measurement.setting);
  json["is_truth"] = figures.is_truth;
  json["recall_per_play"] = figures.measurement.recalls;
  if (const auto recall = recall_interval(figures); recall && figures.measurement.recalls.size() > 1) {
    json["recall_low"] = recall->low;
    json["recall_high"] = recall->high;
  }
  json["face_pairs"] = figures.face_pairs.all;
  json["face_pairs_found"] = figures.face_pairs.found;
  return json;
}

}  // namespace lodestone
