// SPDX-License-Identifier: GPL-3.0-or-later
#include <tuple>

#include "lodestone/volumes/all.h"
#include "volumes/volume_entrant.h"

namespace lodestone {

namespace {

template <Bounding_volume Volume>
Contestant volume_contestant(const std::shared_ptr<Scene_division>& division) {
  const auto figures = std::make_shared<Volume_figures>();
  const std::string name(Volume::name);
  return {.kind = Contestant_kind::volume,
          .model = name,
          .strategy = division->strategy(),
          .entry = {.library = "Lodestone",
                    .method = "refit, " + division->strategy(),
                    .volume = name,
                    .build = [division, figures](std::span<const Moving_mesh> meshes) -> std::unique_ptr<Entrant> {
                      return std::make_unique<Volume_entrant<Volume>>(meshes, division, figures);
                    }},
          .figures = figures};
}

template <class... Volumes>
void add_contestants(const std::shared_ptr<Scene_division>& division, std::tuple<Volumes...>*,
                     std::vector<Contestant>& contestants) {
  (contestants.push_back(volume_contestant<Volumes>(division)), ...);
}

}  // namespace

std::vector<Contestant> volume_contestants(const std::vector<std::shared_ptr<Scene_division>>& divisions) {
  std::vector<Contestant> contestants;
  for (const auto& division : divisions)
    add_contestants(division, static_cast<Bounding_volumes*>(nullptr), contestants);
  return contestants;
}

}  // namespace lodestone
