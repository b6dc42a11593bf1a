// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/scene_division.h"

#include <array>

#include "lodestone/mesh/stopwatch.h"
#include "lodestone/partition/partition.h"
#include "lodestone/partition/strategies.h"

namespace lodestone {

namespace {

std::vector<Region_index> labels_of(const Moving_mesh& moving, const Any_strategy& strategy, double& seconds) {
  const Mesh_numbering<Surface_mesh> numbering(*moving.mesh);
  const Vertex_graph graph = vertex_graph(numbering.vertex_count(), numbering.corners());
  const Positions positions = read_positions(numbering, moving.mesh->points());
  Numbered_partition partition;
  timed(seconds, [&] {
    partition = partition_numbered(Partition_input<Surface_mesh>{*moving.mesh, numbering, graph, positions},
                                   division_regions, strategy);
  });
  return std::move(partition.labels);
}

}  // namespace

std::span<const std::string_view> dividing_strategies() {
  static constexpr std::array<std::string_view, 4> all{"lbg", "lbg_position", "median_split", "vsa"};
  return all;
}

Scene_division::Scene_division(std::string_view strategy, std::span<const Moving_mesh> meshes) : strategy_(strategy) {
  for (const auto& moving : meshes) {
    const auto& labels = labels_.emplace_back(labels_of(moving, make_strategy(strategy), seconds_));
    pieces_.push_back(pieces_of(Tree_layout(moving.corners, labels, moving.coordinates(), {}), moving.corners, labels));
  }
}

const Scene_division::Measure& Scene_division::measure(std::size_t frame, std::span<const Tree_layout* const> layouts,
                                                       std::span<const Moving_mesh> meshes) {
  const auto [found, is_new] = measures_.try_emplace(frame);
  Measure& measure = found->second;
  if (!is_new) return measure;
  for (std::size_t object = 0; object < meshes.size(); ++object) {
    const Coordinates coordinates = meshes[object].coordinates();
    auto& chosen = measure.regions.emplace_back();
    for (const auto& region : pieces_[object].regions)
      chosen.push_back(choose_faces(region, meshes[object].corners, coordinates));
    add_hulls(*layouts[object], pieces_[object], coordinates, measure.hulls);
  }
  return measure;
}

std::vector<std::shared_ptr<Scene_division>> divide(std::span<const Moving_mesh> meshes) {
  std::vector<std::shared_ptr<Scene_division>> divisions;
  for (const auto strategy : dividing_strategies())
    divisions.push_back(std::make_shared<Scene_division>(strategy, meshes));
  return divisions;
}

}  // namespace lodestone
