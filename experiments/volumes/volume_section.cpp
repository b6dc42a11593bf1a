// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of one scene.
#include <fmt/format.h>

#include "lodestone/io/results/text_table.h"
#include "shared/race_figures.h"
#include "volumes/volume_cells.h"
#include "volumes/volume_report.h"

namespace lodestone {

namespace {

/// Number of wrong answers; for particles, which may miss collisions, the collisions seen.
std::string answers_cell(const Volume_scene& scene, std::size_t index) {
  const Entry_figures& f = scene.race.entries[index];
  if (!f.entry.answers) return no_cell;
  if (f.left_early) return "left early";
  if (scene.contestants[index].kind == Contestant_kind::particles) return seen_cell(scene, index);
  return std::to_string(f.missed + f.invented + f.wrong_sets + f.wrong_later);
}

void add_row(const Volume_scene& scene, std::size_t index, Text_table& table) {
  const Contestant& c = scene.contestants[index];
  const Entry_figures& f = scene.race.entries[index];
  const auto time = [&](bool shown, double Frame_seconds::*figure) {
    return shown ? milliseconds(median_of(f, figure)) : no_cell;
  };
  const auto ratio = [&](bool shown, double Frame_seconds::*figure, std::string_view to) {
    return shown && !f.left_early ? ratio_cell(median_of(f, figure) / scene.seconds(to, reference_strategy, figure))
                                  : no_cell;
  };
  const auto count = [&](std::size_t Volume_figures::*counted) {
    return c.figures ? fmt::format("{:.0f}", c.figures->per_frame(counted)) : no_cell;
  };
  const bool any = f.entry.answers, all = f.entry.reports_pairs;
  table.add({c.model, c.strategy.empty() ? no_cell : c.strategy, time(true, &Frame_seconds::update),
             ratio(true, &Frame_seconds::update, reference_model), time(any, &Frame_seconds::any),
             time(any, &Frame_seconds::update_and_any), ratio(any, &Frame_seconds::update_and_any, reference_model),
             ratio(any, &Frame_seconds::update_and_any, reference_particles), time(all, &Frame_seconds::all),
             time(all, &Frame_seconds::update_and_all), ratio(all, &Frame_seconds::update_and_all, reference_model),
             count(&Volume_figures::volume_tests), count(&Volume_figures::leaf_pairs),
             count(&Volume_figures::exact_tests), answers_cell(scene, index),
             c.figures ? std::to_string(c.figures->node_bytes) : no_cell,
             std::to_string(f.passes / scene.race.sampled.size())});
}

std::string times_table(const Volume_scene& scene) {
  Text_table table({"volume", "regions by", "update (ms)", "/ aabb", "yes/no (ms)", "update + yes/no (ms)", "/ aabb",
                    "/ 32 particles", "all pairs (ms)", "update + all pairs (ms)", "/ aabb", "overlap tests",
                    "leaf pairs", "exact tests", "wrong, or seen", "bytes per volume", "passes"});
  for (std::size_t index = 0; index < scene.contestants.size(); ++index) add_row(scene, index, table);
  return table.text();
}

std::string partitions_text(const Volume_scene& scene) {
  std::string text = "The partitions of all objects together took";
  for (const auto& [strategy, seconds] : scene.divisions)
    text += fmt::format("{} {} s by `{}`", &strategy == &scene.divisions.front().strategy ? "" : ",",
                        seconds_cell(seconds), strategy);
  return text + ".\n\n";
}

/// A row for each strategy and kind of piece, a column for each volume.
std::string tightness_by_strategy(const Volume_scene& scene) {
  const auto models = scene.models();
  std::vector<std::string> header{"regions by", "of"};
  header.insert(header.end(), models.begin(), models.end());
  Text_table table(header);
  for (const auto strategy : dividing_strategies())
    for (const auto& [piece, figure] : tightness_pieces) {
      std::vector<std::string> row{std::string(strategy), piece};
      for (const auto& model : models) {
        const auto index = static_cast<std::size_t>(scene.index_of(model, strategy));
        const auto& figures = *scene.contestants[index].figures;
        row.push_back(fmt::format("{} / {}", ratio_cell(figures.first.*figure), ratio_cell(figures.last.*figure)));
      }
      table.add(std::move(row));
    }
  return table.text();
}

/// Names the rows that do not cover all frames, and says whether all contestants took turns.
std::string notes(const Volume_scene& scene) {
  std::string text;
  if (scene.race.batches > 1)
    text +=
        fmt::format("- Memory held one of {} groups at a time, so contestants took turns only within their group.\n",
                    scene.race.batches);
  for (const auto& f : scene.race.entries)
    if (f.left_early)
      text += fmt::format("- {} ({}) played {} of the {} frames, then ran out of time.\n", f.entry.method,
                          f.entry.volume, f.frames.size(), scene.race.sampled.size());
  return text.empty() ? text : text + "\n";
}

}  // namespace

std::string volume_section(const Volume_scene& scene) {
  std::string text = scene_heading(scene.race);
  text += partitions_text(scene) + notes(scene);
  text += titled("Per frame", times_table(scene));
  text += titled("Tightness in the first / last sampled frame", tightness_by_strategy(scene));
  return text;
}

}  // namespace lodestone
