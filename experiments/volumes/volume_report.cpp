// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/volume_report.h"

#include <fmt/format.h>

#include <cmath>

#include "lodestone/io/results/text_table.h"
#include "volumes/volume_cells.h"

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

/// Times of the volumes, as ratios to those of the model `to`.
std::string ratios_table(std::span<const Volume_scene> scenes, double Frame_seconds::*figure, std::string_view to) {
  return scenes_table(scenes, scenes[0].models(), [&](const Volume_scene& scene, const std::string& model) {
    return ratio_cell(scene.seconds(model, reference_strategy, figure) / scene.seconds(to, reference_strategy, figure));
  });
}

/// Share of the update in update + all pairs.
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
    const auto index = static_cast<std::size_t>(scene.index_of(model, reference_strategy));
    const double boxes = scene.seconds(reference_model, reference_strategy, figure);
    const auto& particles = *scene.contestants[index].particles;
    return fmt::format("{} / {} / {:.0f} / {}", ratio_cell(scene.seconds(model, reference_strategy, figure) / boxes),
                       ratio_cell(particles.mean_seconds() / boxes),
                       100.0 * static_cast<double>(particles.repartitions) / static_cast<double>(particles.frames),
                       seen_cell(scene, index));
  });
}

/// Times of the volumes, as ratios to the mean frame of 32 particles.
std::string mean_ratios_table(std::span<const Volume_scene> scenes) {
  return scenes_table(scenes, scenes[0].models(), [&](const Volume_scene& scene, const std::string& model) {
    const auto index = static_cast<std::size_t>(scene.index_of(reference_particles, reference_strategy));
    return ratio_cell(scene.seconds(model, reference_strategy, &Frame_seconds::update_and_any) /
                      scene.contestants[index].particles->mean_seconds());
  });
}

/// A row for each strategy, a column for each volume: geometric means over the scenes.
template <class Figure>
std::string strategies_table(std::span<const Volume_scene> scenes, const Figure& figure) {
  const auto models = scenes[0].models();
  std::vector<std::string> header{"regions by"};
  header.insert(header.end(), models.begin(), models.end());
  Text_table table(header);
  for (const auto strategy : dividing_strategies()) {
    std::vector<std::string> row{std::string(strategy)};
    for (const auto& model : models) {
      double sum = 0;
      for (const auto& scene : scenes) sum += std::log(figure(scene, model, strategy));
      row.push_back(ratio_cell(std::exp(sum / static_cast<double>(scenes.size()))));
    }
    table.add(std::move(row));
  }
  return table.text();
}

/// Times by strategy, as ratios to the same volume over regions by the reference strategy.
std::string strategy_times_table(std::span<const Volume_scene> scenes, double Frame_seconds::*figure) {
  return strategies_table(scenes, [&](const Volume_scene& scene, const std::string& model, std::string_view strategy) {
    return scene.seconds(model, strategy, figure) / scene.seconds(model, reference_strategy, figure);
  });
}

std::string tightness_table(std::span<const Volume_scene> scenes, double Tightness::*figure) {
  return strategies_table(scenes, [&](const Volume_scene& scene, const std::string& model, std::string_view strategy) {
    return tightness(scene, model, strategy).*figure;
  });
}

}  // namespace

std::string volume_report(std::span<const Volume_scene> scenes) {
  std::string text = fmt::format(
      "One core. Every tree stands over a partition into {} regions, by `{}` where a table names no strategy. Times "
      "are medians over the frames.\n\n",
      division_regions, reference_strategy);
  text += titled("Update, in times of aabb", ratios_table(scenes, &Frame_seconds::update, reference_model));
  text += titled("Update + yes/no, in times of aabb",
                 ratios_table(scenes, &Frame_seconds::update_and_any, reference_model));
  text += titled("Update + all pairs, in times of aabb",
                 ratios_table(scenes, &Frame_seconds::update_and_all, reference_model));
  text += titled("Share of the update in update + all pairs", update_share_table(scenes));
  text += titled("Update + yes/no, in times of the median frame of 32 particles per object",
                 ratios_table(scenes, &Frame_seconds::update_and_any, reference_particles));
  text += titled("The same, in times of their mean frame, repartitions included", mean_ratios_table(scenes));
  text += titled(
      "Particles: median frame, mean frame (both in times of update + yes/no of aabb) / repartitions in 100 frames / "
      "collisions seen",
      particles_table(scenes));
  text += "The figures of the next tables are geometric means over the scenes.\n\n";
  for (const auto& [what, figure] :
       {std::pair("Update", &Frame_seconds::update), std::pair("Query for all pairs", &Frame_seconds::all),
        std::pair("Update + all pairs", &Frame_seconds::update_and_all)})
    text += titled(
        fmt::format("{} by strategy, in times of the same volume over regions by `{}`", what, reference_strategy),
        strategy_times_table(scenes, figure));
  for (const auto& [piece, figure] : tightness_pieces)
    text += titled(fmt::format("Tightness of {} in the last sampled frame", piece), tightness_table(scenes, figure));
  for (const auto& scene : scenes) text += volume_section(scene);
  text.pop_back();  // the empty line at the end
  return text;
}

}  // namespace lodestone
