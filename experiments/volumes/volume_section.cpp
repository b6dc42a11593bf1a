// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of one scene.
#include <fmt/format.h>

#include <cmath>

#include "lodestone/io/text_table.h"
#include "race_figures.h"
#include "volume_cells.h"
#include "volume_report.h"

namespace lodestone {

namespace {

std::string answers_cell(const Volume_scene& scene, std::size_t place) {
  const Entry_figures& f = scene.race.entries[place];
  if (!f.entry.answers) return no_cell;
  if (f.left_early) return "left early";
  const std::size_t invented = f.invented + f.wrong_sets;
  if (scene.contestants[place].kind == Contestant_kind::particles)
    return scene.race.colliding == 0 ? no_cell : fmt::format("{:.3f}", recall(scene, place));
  return std::to_string(f.missed + invented + f.wrong_later);
}

void add_row(const Volume_scene& scene, std::size_t place, Text_table& table) {
  const Contestant& c = scene.contestants[place];
  const Entry_figures& f = scene.race.entries[place];
  const auto time = [&](bool shown, double Frame_seconds::*figure) {
    return shown ? milliseconds(median_of(f, figure)) : no_cell;
  };
  const auto ratio = [&](bool shown, double Frame_seconds::*figure, std::string_view to) {
    return shown ? ratio_cell(median_of(f, figure) / scene.seconds(to, reference_strategy, figure)) : no_cell;
  };
  const auto count = [&](std::size_t Volume_figures::*counted) {
    return c.figures ? fmt::format("{:.0f}", c.figures->per_frame(counted)) : no_cell;
  };
  const bool any = f.entry.answers, all = f.entry.reports_pairs;
  table.add({c.model, time(true, &Frame_seconds::update), ratio(true, &Frame_seconds::update, reference_model),
             time(any, &Frame_seconds::any), time(any, &Frame_seconds::update_and_any),
             ratio(any, &Frame_seconds::update_and_any, reference_model),
             ratio(any, &Frame_seconds::update_and_any, reference_particles), time(all, &Frame_seconds::all),
             time(all, &Frame_seconds::update_and_all), ratio(all, &Frame_seconds::update_and_all, reference_model),
             count(&Volume_figures::volume_tests), count(&Volume_figures::leaf_pairs),
             count(&Volume_figures::exact_tests), answers_cell(scene, place),
             c.figures ? std::to_string(c.figures->node_bytes) : no_cell});
}

std::string times_table(const Volume_scene& scene) {
  Text_table table({"volume", "update (ms)", "/ aabb", "yes/no (ms)", "update + yes/no (ms)", "/ aabb",
                    "/ 32 particles", "all pairs (ms)", "update + all pairs (ms)", "/ aabb", "overlap tests",
                    "leaf pairs", "exact tests", "wrong, or recall", "bytes per volume"});
  for (std::size_t place = 0; place < scene.contestants.size(); ++place)
    if (const auto& strategy = scene.contestants[place].strategy; strategy.empty() || strategy == reference_strategy)
      add_row(scene, place, table);
  return table.text();
}

/// Strategies against volumes.
template <class Cell>
std::string strategies_table(const Volume_scene& scene, const Cell& cell) {
  const auto models = scene.models();
  std::vector<std::string> header{"strategy", "partition (s)"};
  header.insert(header.end(), models.begin(), models.end());
  Text_table table(header);
  for (const auto& [strategy, seconds] : scene.divisions) {
    std::vector<std::string> row{strategy, fmt::format("{:.2f}", seconds)};
    for (const auto& model : models) row.push_back(cell(model, strategy));
    table.add(std::move(row));
  }
  return table.text();
}

std::string update_and_all_table(const Volume_scene& scene) {
  constexpr auto figure = &Frame_seconds::update_and_all;
  const double reference = scene.seconds(reference_model, reference_strategy, figure);
  return strategies_table(scene, [&](const std::string& model, const std::string& strategy) {
    return ratio_cell(scene.seconds(model, strategy, figure) / reference);
  });
}

std::string walk_table(const Volume_scene& scene) {
  return strategies_table(scene, [&](const std::string& model, const std::string& strategy) {
    const auto& figures = *scene.contestants[static_cast<std::size_t>(scene.place_of(model, strategy))].figures;
    return fmt::format("{:.0f} / {:.0f}", figures.per_frame(&Volume_figures::volume_tests),
                       figures.per_frame(&Volume_figures::leaf_pairs));
  });
}

std::string regions_table(const Volume_scene& scene) {
  return strategies_table(scene, [&](const std::string& model, const std::string& strategy) {
    return ratio_cell(tightness(scene, model, strategy).regions);
  });
}

std::string tightness_table(const Volume_scene& scene) {
  Text_table table({"volume", "leaves, first", "leaves, last", "regions, first", "regions, last",
                    "regions refitted, first", "regions refitted, last", "objects, first", "objects, last"});
  for (const auto& model : scene.models()) {
    const auto place = static_cast<std::size_t>(scene.place_of(model, reference_strategy));
    const auto &first = scene.contestants[place].figures->first, &last = scene.contestants[place].figures->last;
    table.add({model, ratio_cell(first.leaves), ratio_cell(last.leaves), ratio_cell(first.regions),
               ratio_cell(last.regions), ratio_cell(first.regions_refitted), ratio_cell(last.regions_refitted),
               ratio_cell(first.objects), ratio_cell(last.objects)});
  }
  return table.text();
}

/// Says what is missing.
std::string notes(const Volume_scene& scene) {
  std::string text;
  for (const auto& strategy : scene.left_out)
    for (const auto& dividing : dividings())
      if (dividing.strategy == strategy)
        text +=
            fmt::format("- {} is left out: an object has more than {} vertices.\n", strategy, dividing.most_vertices);
  for (const auto& f : scene.race.entries)
    if (f.left_early)
      text += fmt::format("- {} ({}) played {} of the {} frames, then its time was over.\n", f.entry.method,
                          f.entry.volume, f.frames.size(), scene.race.sampled.size());
  return text.empty() ? text : text + "\n";
}

}  // namespace

std::string volume_section(const Volume_scene& scene) {
  const auto& race = scene.race;
  std::string text = fmt::format(
      "## {}\n\n{} objects, {} triangles and {} vertices together. {} of {} frames. The bounding boxes of {} object "
      "pairs overlap, {} of these intersect, in {} face pairs.\n\n",
      race.name, race.objects, race.triangles, race.vertices, race.sampled.size(), race.frames, race.asked,
      race.colliding, race.contacts);
  text += notes(scene);
  text += titled(fmt::format("Regions by `{}`", reference_strategy), times_table(scene));
  text += titled("Update + all pairs by strategy, in times of aabb with lbg", update_and_all_table(scene));
  text += titled("Overlap tests / leaf pairs per frame by strategy", walk_table(scene));
  text += titled(fmt::format("Tightness, regions by `{}`, in the first and the last sampled frame", reference_strategy),
                 tightness_table(scene));
  text += titled("Tightness of regions in the last sampled frame by strategy", regions_table(scene));
  return text;
}

}  // namespace lodestone
