// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/io/scene_file.h"
#include "score.h"

namespace lodestone {

/// One way of asking: a name for the table, and the options behind it. `contacts` does not count: frames are scored,
/// and timed, as yes or no.
struct Setting {
  std::string name;
  Detector_options options = {};
  Any_strategy strategy = {};
};

/// What one setting gave on one or more scenes.
struct Measurement {
  Setting setting;
  Score score = {};
  std::vector<double> accuracies = {};        ///< per scene
  std::vector<Frame_statistics> frames = {};  ///< per frame of all scenes
  std::vector<std::size_t> particles = {};    ///< per object of the last scene, at its end
  double preparation_seconds = 0;             ///< partition of all objects, all scenes together
};

/// What answers are held against.
enum class Truth_source {
  exhaustive,  ///< every face against every other
  exact_mode   ///< the mode `exact`, which gives the same: the experiment `peers` checks it on sampled frames
};

/// Times of the truth, and the measurements, on the same frames in the same process.
struct Measured_run {
  std::vector<Measurement> measurements;
  std::vector<double> oracle_seconds;  ///< exhaustive exact checking, per frame, all pairs together
};

/// Plays the scenes one after the other. In every frame all settings and the oracle answer in turn.
///
/// The first frame of a scene, in which surfaces are partitioned, is scored but not timed.
///
/// @param truth  of large scenes: exhaustive checking would take longer than all else together
Measured_run measure(std::span<Scene> scenes, std::span<const Setting> settings,
                     const std::function<void(std::size_t, std::size_t)>& progress,
                     Truth_source truth = Truth_source::exhaustive);

double median(std::vector<double> values);
/// Median over the frames of one figure, such as `&Stage_times::relaxation`, in microseconds.
double median_microseconds(const Measurement& measurement, double Stage_times::*stage);
double median_total_microseconds(const Measurement& measurement);
/// Repartitions, which are rare and dear, show in the mean only.
double mean_total_microseconds(const Measurement& measurement);
/// Mean over the frames of one count, such as `&Frame_statistics::iterations`.
double mean_count(const Measurement& measurement, std::size_t Frame_statistics::*count);

/// The figures of a measurement as JSON.
nlohmann::ordered_json to_json(const Measurement& measurement);
/// Writes `<folder>/<name>.json`.
void write_json(const std::filesystem::path& folder, std::string_view name, const nlohmann::ordered_json& json);

}  // namespace lodestone
