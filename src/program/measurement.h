// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/detection/frame.h"
#include "lodestone/detection/detector_options.h"
#include "lodestone/partition/strategies.h"
#include "program/score.h"

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
