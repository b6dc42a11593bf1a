// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "shared/experiment.h"
#include "shared/race.h"

/// What the experiments that are races have in common: their scenes, and how figures become text and JSON.
namespace lodestone {

/// Called with the share of a scene's work that is done; may throw to stop.
using Scene_progress = std::function<void(double share)>;

/// The scenes that the caller asked for, or those of the published figures.
/// @throws Bad_scene  a name that no scene has
std::vector<std::string> scene_names(const Experiment_context& context);

/// Reads the scenes that the caller asked for, or those of the published figures, and visits each in turn.
/// @throws Bad_scene  a name that no scene has, before the first visit
void for_each_scene(const Experiment_context& context,
                    const std::function<void(Scene& scene, const Scene_progress& progress)>& visit);

/// Heading of a scene's section, with how much was measured.
std::string scene_heading(const Scene_figures& scene);
/// The same figures, and the sampled frames, as the first keys of a scene's object.
nlohmann::ordered_json scene_figures_json(const Scene_figures& scene);

/// One figure, in each frame that an entry played.
std::vector<double> values(const Entry_figures& figures, double Frame_seconds::*figure);
double median_of(const Entry_figures& figures, double Frame_seconds::*figure);
/// The least value that 95 % of the values do not exceed.
double percentile_95(std::vector<double> values);

/// Three to four digits; a dash for what was not measured.
std::string milliseconds(double seconds);

}  // namespace lodestone
