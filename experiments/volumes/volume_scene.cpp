// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/volume_scene.h"

#include <algorithm>
#include <limits>

#include "shared/race_figures.h"

namespace lodestone {

namespace {

std::vector<std::shared_ptr<Scene_division>> divide_first_frame(Scene& scene) {
  std::vector<Mesh_numbering<Surface_mesh>> numberings;
  numberings.reserve(scene.objects.size());
  std::vector<Moving_mesh> meshes;
  for (auto& object : scene.objects) {
    pose(object, 0);
    meshes.push_back({&object.mesh, numberings.emplace_back(object.mesh).corners()});
  }
  return divide(meshes);
}

}  // namespace

std::ptrdiff_t Volume_scene::index_of(std::string_view model, std::string_view strategy) const {
  const auto found = std::ranges::find_if(
      contestants, [&](const auto& c) { return c.model == model && (c.strategy == strategy || c.strategy.empty()); });
  return found == contestants.end() ? -1 : found - contestants.begin();
}

double Volume_scene::seconds(std::string_view model, std::string_view strategy, double Frame_seconds::*figure) const {
  const auto index = index_of(model, strategy);
  if (index < 0 || race.entries[static_cast<std::size_t>(index)].left_early)
    return std::numeric_limits<double>::quiet_NaN();
  return median_of(race.entries[static_cast<std::size_t>(index)], figure);
}

std::vector<std::string> Volume_scene::models() const {
  std::vector<std::string> names;
  for (const auto& c : contestants)
    if (c.kind == Contestant_kind::volume && std::ranges::find(names, c.model) == names.end()) names.push_back(c.model);
  return names;
}

Volume_scene measure_volumes(Scene& scene, const Race_options& options, const std::function<void(double)>& progress) {
  Volume_scene result;
  std::vector<Entry> entries;
  {
    const auto divisions = divide_first_frame(scene);
    for (const auto& division : divisions) result.divisions.push_back({division->strategy(), division->seconds()});
    result.contestants = all_contestants(divisions);
  }
  for (const auto& contestant : result.contestants) entries.push_back(contestant.entry);
  result.race = measure_race(scene, entries, options, progress);

  // The build functions hold the divisions, which are no longer needed.
  for (auto& contestant : result.contestants) contestant.entry.build = nullptr;
  for (auto& figures : result.race.entries) figures.entry.build = nullptr;
  return result;
}

}  // namespace lodestone
