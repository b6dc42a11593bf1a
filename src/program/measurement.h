// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"
#include "lodestone/partition/strategies.h"
#include "program/score.h"

namespace lodestone {

/// One row of a table: its name, and the options to measure. `contacts` is ignored: frames are scored and timed as yes
/// or no.
struct Setting {
  std::string name;
  Detector_options options = {};
  Any_strategy strategy = {};
};

/// The results of one setting on one or more scenes.
struct Measurement {
  Setting setting;
  Score score = {};
  std::vector<double> accuracies = {};        ///< per scene, or per play of one
  std::vector<double> recalls = {};           ///< the same
  std::vector<Frame_statistics> frames = {};  ///< per frame of all scenes
  std::vector<std::size_t> particles = {};    ///< per object of the last scene, at its end
  double build_seconds = 0;                   ///< of all objects, summed over all frames
};

/// 0 if there are none.
double mean(std::span<const double> values);
/// The mean of the two in the middle if their number is even; 0 if there are none.
double median(std::vector<double> values);
/// Median over the frames of one time, such as `&Stage_times::relaxation`, in microseconds.
double median_microseconds(const Measurement& measurement, double Stage_times::*stage);
/// Median over the frames of all stages but `build`, which objects pay once, in microseconds.
double median_microseconds_without_build(const Measurement& measurement);
/// The mean of the same. Repartitions, which are rare and slow, show only in the mean.
double mean_microseconds_without_build(const Measurement& measurement);
/// Mean over the frames of one count, such as `&Frame_statistics::iterations`.
double mean_count(const Measurement& measurement, std::size_t Frame_statistics::*count);

/// The figures of a measurement as JSON.
nlohmann::ordered_json to_json(const Measurement& measurement);
/// Writes `<folder>/<name>.json`.
void write_json(const std::filesystem::path& folder, std::string_view name, const nlohmann::ordered_json& json);

}  // namespace lodestone
