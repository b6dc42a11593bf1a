// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lodestone/io/text_table.h"
#include "volume_cells.h"

namespace lodestone {

namespace {

/// A row for each scene, a column for each volume.
template <class Cell>
std::string scenes_table(std::span<const Volume_scene> scenes, const std::vector<std::string>& columns,
                         const Cell& cell) {
  std::vector<std::string> header{"scene", "triangles"};
  header.insert(header.end(), columns.begin(), columns.end());
  Text_table table(header);
  for (const auto& scene : scenes) {
    std::vector<std::string> row{scene.race.name, std::to_string(scene.race.triangles)};
    for (const auto& column : columns) row.push_back(cell(scene, column));
    table.add(std::move(row));
  }
  return table.text();
}

/// Volumes in times of something else.
std::string ratios_table(std::span<const Volume_scene> scenes, double Frame_seconds::*figure, std::string_view to) {
  return scenes_table(scenes, scenes[0].models(), [&](const Volume_scene& scene, const std::string& model) {
    return ratio_cell(scene.seconds(model, reference_strategy, figure) / scene.seconds(to, reference_strategy, figure));
  });
}

/// What a frame of volumes costs beside one of particles: the share of it that is the update.
std::string update_share_table(std::span<const Volume_scene> scenes) {
  return scenes_table(scenes, scenes[0].models(), [&](const Volume_scene& scene, const std::string& model) {
    return ratio_cell(scene.seconds(model, reference_strategy, &Frame_seconds::update) /
                      scene.seconds(model, reference_strategy, &Frame_seconds::update_and_all));
  });
}

std::string particles_table(std::span<const Volume_scene> scenes) {
  std::vector<std::string> columns;
  for (const auto& c : scenes[0].contestants)
    if (c.kind == Contestant_kind::particles) columns.push_back(c.model);
  constexpr auto figure = &Frame_seconds::update_and_any;
  return scenes_table(scenes, columns, [&](const Volume_scene& scene, const std::string& model) {
    const auto place = static_cast<std::size_t>(scene.place_of(model, reference_strategy));
    const double ratio =
        scene.seconds(model, reference_strategy, figure) / scene.seconds(reference_model, reference_strategy, figure);
    return scene.race.colliding == 0 ? ratio_cell(ratio)
                                     : fmt::format("{} ({:.3f})", ratio_cell(ratio), recall(scene, place));
  });
}

/// Geometric mean over the scenes that every strategy took part in.
double mean_tightness(std::span<const Volume_scene> scenes, const std::string& model, std::string_view strategy) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& scene : scenes) {
    if (!scene.left_out.empty()) continue;
    sum += std::log(tightness(scene, model, strategy).regions);
    ++count;
  }
  return std::exp(sum / static_cast<double>(count));
}

std::string tightness_table(std::span<const Volume_scene> scenes) {
  const auto models = scenes[0].models();
  std::vector<std::string> header{"strategy"};
  header.insert(header.end(), models.begin(), models.end());
  Text_table table(header);
  for (const auto& dividing : dividings()) {
    std::vector<std::string> row{std::string(dividing.strategy)};
    for (const auto& model : models) row.push_back(ratio_cell(mean_tightness(scenes, model, dividing.strategy)));
    table.add(std::move(row));
  }
  return table.text();
}

}  // namespace

std::string volume_report(std::span<const Volume_scene> scenes) {
  std::string text = fmt::format(
      "One core. Volumes are those of trees over {} regions, by `{}` where a table names no strategy. Times are "
      "medians "
      "over the frames.\n\n",
      division_regions, reference_strategy);
  text += titled("Update, in times of aabb", ratios_table(scenes, &Frame_seconds::update, reference_model));
  text += titled("Update + yes/no, in times of aabb",
                 ratios_table(scenes, &Frame_seconds::update_and_any, reference_model));
  text += titled("Update + all pairs, in times of aabb",
                 ratios_table(scenes, &Frame_seconds::update_and_all, reference_model));
  text += titled("Share of the update in update + all pairs", update_share_table(scenes));
  text += titled("Update + yes/no, in times of 32 particles per object",
                 ratios_table(scenes, &Frame_seconds::update_and_any, reference_particles));
  text += titled("Update + yes/no of particles, in times of aabb (and their recall)", particles_table(scenes));
  text += titled(
      "Tightness of regions in the last sampled frame, geometric mean over the scenes that every strategy "
      "took part in",
      tightness_table(scenes));
  for (const auto& scene : scenes) text += volume_section(scene);
  text.pop_back();  // the empty line at the end
  return text;
}

}  // namespace lodestone
