// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/race.h"
#include "volumes/contestants.h"

namespace lodestone {

/// Time of the partitions of a scene by one strategy.
struct Division_time {
  std::string strategy;
  double seconds = 0;  ///< of all objects together
};

/// Result of the race of the volumes on one scene.
struct Volume_scene {
  Scene_figures race;
  std::vector<Contestant> contestants;   ///< per entry of the race
  std::vector<Division_time> divisions;  ///< per strategy

  /// Index of a contestant among the entries; -1: it did not take part.
  std::ptrdiff_t index_of(std::string_view model, std::string_view strategy) const;
  /// Seconds in the median frame; not a number if the contestant did not take part or left early.
  double seconds(std::string_view model, std::string_view strategy, double Frame_seconds::*figure) const;
  /// Names of the volumes.
  std::vector<std::string> models() const;
};

/// Divides the scene by every strategy, and races all contestants on it.
/// @param progress  share of the work that is done; may throw to stop
Volume_scene measure_volumes(Scene& scene, const Race_options& options, const std::function<void(double)>& progress);

}  // namespace lodestone
