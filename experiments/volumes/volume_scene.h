// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/race.h"
#include "volumes/contestants.h"

namespace lodestone {

/// How long the partitions of a scene took.
struct Division_time {
  std::string strategy;
  double seconds = 0;  ///< of all objects together
};

/// What a race of the volumes on one scene gave.
struct Volume_scene {
  Scene_figures race;
  std::vector<Contestant> contestants;   ///< per entry of the race
  std::vector<Division_time> divisions;  ///< per strategy

  /// Place of a contestant among the entries; -1: it did not take part.
  std::ptrdiff_t place_of(std::string_view model, std::string_view strategy) const;
  /// Seconds in the median frame; not a number if it did not take part or left early.
  double seconds(std::string_view model, std::string_view strategy, double Frame_seconds::*figure) const;
  /// Names of the volumes.
  std::vector<std::string> models() const;
};

/// Divides the scene, and plays sampled frames of it with everybody.
/// @param progress  share of the work that is done; may throw to stop
Volume_scene measure_volumes(Scene& scene, const Race_options& options, const std::function<void(double)>& progress);

}  // namespace lodestone
