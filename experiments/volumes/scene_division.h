// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "shared/moving_mesh.h"
#include "volumes/tree_pieces.h"

namespace lodestone {

/// Names of the strategies that the experiment compares, `lbg` first.
std::span<const std::string_view> dividing_strategies();

/// Regions of each object at the top of its tree.
constexpr std::size_t division_regions = 64;

/// All objects of a scene, divided by one strategy in the first frame. The trees of all volumes share it.
class Scene_division {
 public:
  Scene_division(std::string_view strategy, std::span<const Moving_mesh> meshes);

  const std::string& strategy() const { return strategy_; }
  /// Time of all partitions together.
  double seconds() const { return seconds_; }
  std::span<const Region_index> labels(std::size_t object) const { return labels_[object]; }
  const Tree_pieces& pieces(std::size_t object) const { return pieces_[object]; }

  /// What tightness compares the volumes of a frame with. It is the same for all volumes, so it is computed once.
  struct Measure {
    std::vector<std::vector<Chosen_faces>> regions;  ///< per object and region
    Hull_sums hulls;
  };
  /// @param frame    index under which the result is kept
  /// @param layouts  per object: of a tree with these labels
  const Measure& measure(std::size_t frame, std::span<const Tree_layout* const> layouts,
                         std::span<const Moving_mesh> meshes);

 private:
  std::string strategy_;
  double seconds_ = 0;
  std::vector<std::vector<Region_index>> labels_;  ///< per object
  std::vector<Tree_pieces> pieces_;                ///< per object
  std::map<std::size_t, Measure> measures_;        ///< by frame
};

/// Divides a scene by every strategy.
std::vector<std::shared_ptr<Scene_division>> divide(std::span<const Moving_mesh> meshes);

}  // namespace lodestone
