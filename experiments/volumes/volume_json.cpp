// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "shared/race_figures.h"
#include "volumes/volume_cells.h"
#include "volumes/volume_report.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no numbers that are not finite.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

const char* name_of(Contestant_kind kind) {
  constexpr const char* names[] = {"bound", "volume", "particles"};
  return names[static_cast<int>(kind)];
}

struct Named_figure {
  const char* name;
  double Frame_seconds::*figure;
};

constexpr Named_figure named_figures[] = {{"update", &Frame_seconds::update},
                                          {"yes_no", &Frame_seconds::any},
                                          {"all_pairs", &Frame_seconds::all},
                                          {"update_and_yes_no", &Frame_seconds::update_and_any},
                                          {"update_and_all_pairs", &Frame_seconds::update_and_all}};

/// Whether an entry has a figure.
bool has(const Entry_figures& f, double Frame_seconds::*figure) {
  if (figure == &Frame_seconds::update) return true;
  const bool of_all = figure == &Frame_seconds::all || figure == &Frame_seconds::update_and_all;
  return of_all ? f.entry.reports_pairs : f.entry.answers;
}

Json row_of(const Volume_scene& scene, std::size_t index) {
  const Contestant& c = scene.contestants[index];
  const Entry_figures& f = scene.race.entries[index];
  Json row{{"scene", scene.race.name},
           {"triangles", scene.race.triangles},
           {"kind", name_of(c.kind)},
           {"model", c.model},
           {"strategy", c.strategy}};
  for (const auto& [name, figure] : named_figures) {
    if (!has(f, figure)) continue;
    row[std::string(name) + "_ms"] = number(1e3 * median_of(f, figure));
    row[std::string(name) + "_p95_ms"] = number(1e3 * percentile_95(values(f, figure)));
    row[std::string(name) + "_over_aabb"] =
        number(median_of(f, figure) / scene.seconds(reference_model, reference_strategy, figure));
  }
  row["passes"] = f.passes;
  row["left_early"] = f.left_early;
  row["build_s"] = f.build_seconds;
  row["heap_bytes"] = f.bytes;
  if (f.entry.answers) {
    row["missed"] = f.missed;
    row["invented"] = f.invented;
    row["recall"] = scene.race.colliding == 0 || f.left_early ? Json() : number(recall(scene, index));
  }
  if (c.particles) {
    row["mean_ms"] = number(1e3 * c.particles->mean_seconds());
    row["played_frames"] = c.particles->frames;
    row["repartitions"] = c.particles->repartitions;
  }
  if (f.entry.reports_pairs && c.figures) {
    row["wrong_sets"] = f.wrong_sets + f.wrong_later;
    row["nodes"] = c.figures->nodes;
    row["volume_bytes"] = c.figures->node_bytes;
    row["volume_tests"] = c.figures->per_frame(&Volume_figures::volume_tests);
    row["leaf_pairs"] = c.figures->per_frame(&Volume_figures::leaf_pairs);
    row["exact_tests"] = c.figures->per_frame(&Volume_figures::exact_tests);
  }
  return row;
}

void add_tightness(const Volume_scene& scene, const Contestant& c, Json& rows) {
  for (const auto& [frame, tightness] : {std::pair("first", &c.figures->first), std::pair("last", &c.figures->last)})
    for (const auto& [piece, figure] : tightness_pieces)
      rows.push_back({{"scene", scene.race.name},
                      {"model", c.model},
                      {"strategy", c.strategy},
                      {"frame", frame},
                      {"piece", piece},
                      {"tightness", number(tightness->*figure)}});
}

Json frames_of(const Volume_scene& scene, std::size_t index) {
  const Contestant& c = scene.contestants[index];
  const Entry_figures& f = scene.race.entries[index];
  Json json{{"model", c.model}, {"strategy", c.strategy}};
  for (const auto& [name, figure] : named_figures)
    if (has(f, figure)) json[std::string(name) + "_s"] = values(f, figure);
  return json;
}

Json scene_json(const Volume_scene& scene) {
  Json json = scene_figures_json(scene.race);
  for (const auto& [strategy, seconds] : scene.divisions)
    json["partitions"].push_back({{"strategy", strategy}, {"seconds", seconds}});
  for (std::size_t index = 0; index < scene.contestants.size(); ++index)
    json["entries"].push_back(frames_of(scene, index));
  return json;
}

}  // namespace

Json volume_json(std::span<const Volume_scene> scenes) {
  Json json{{"regions", division_regions}, {"rows", Json::array()}, {"tightness", Json::array()}};
  for (const auto& scene : scenes) {
    for (std::size_t index = 0; index < scene.contestants.size(); ++index) {
      json["rows"].push_back(row_of(scene, index));
      if (scene.contestants[index].figures) add_tightness(scene, scene.contestants[index], json["tightness"]);
    }
    json["scenes"].push_back(scene_json(scene));
  }
  return json;
}

}  // namespace lodestone
