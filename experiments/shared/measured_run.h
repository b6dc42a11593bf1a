// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "program/measurement.h"

namespace lodestone {

/// What answers are compared with.
enum class Truth_source {
  exhaustive,  ///< every face against every other
  exact_mode   ///< the mode `exact`, which gives the same answers: the experiment `every_frame` checks that
};

/// Times of the truth and of all settings, on the same frames in the same process.
struct Measured_run {
  std::vector<Measurement> measurements;
  std::vector<double> exhaustive_seconds;  ///< exhaustive exact checking, per frame, all pairs together
};

/// Plays the scenes one after the other. In every frame exhaustive checking and all settings answer in turn.
///
/// The first frame of a scene is scored; of its times only `build` counts.
///
/// @param truth  `exact_mode` for large scenes, where exhaustive checking would take longer than all else together
Measured_run measure(std::span<Scene> scenes, std::span<const Setting> settings,
                     const std::function<void(std::size_t, std::size_t)>& progress,
                     Truth_source truth = Truth_source::exhaustive);

}  // namespace lodestone
