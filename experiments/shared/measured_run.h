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

/// How scenes are measured.
struct Measure_options {
  /// `exact_mode` for large scenes, where exhaustive checking would take longer than all else together.
  Truth_source truth = Truth_source::exhaustive;
  /// Each scene is played so many times, with other partitions in each play: in play i of n, counted from 0, the
  /// detectors build the objects in the pose of frame i F / n of F, and then answer in all frames. >= 1
  std::size_t plays = 1;
};

/// Times of the truth and of all settings, on the same frames in the same process.
struct Measured_run {
  std::vector<Measurement> measurements;
  std::vector<double> exhaustive_seconds;  ///< exhaustive exact checking, per frame, all pairs together
};

/// The order in which n settings answer in a frame. Each frame starts with another setting, because the first one finds
/// the positions outside the caches; and the setting before another one differs from frame to frame, because it leaves
/// what it read in the caches.
/// @return each of 0 .. n - 1 once
std::vector<std::size_t> order_of_turns(std::size_t frame, std::size_t settings);

/// Plays the scenes one after the other. In every frame exhaustive checking and all settings answer in turn.
///
/// The first frame of a play is scored; of its times only `build` counts, unless it is the only frame.
///
/// @param progress  called after each frame with the frames done and the frames of all plays; may throw to stop
Measured_run measure(std::span<Scene> scenes, std::span<const Setting> settings,
                     const std::function<void(std::size_t done, std::size_t of)>& progress,
                     const Measure_options& options = {});

}  // namespace lodestone
