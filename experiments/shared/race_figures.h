// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "shared/experiment.h"
#include "shared/race.h"

/// What the experiments that are races have in common: their scenes, and how figures become a text.
namespace lodestone {

/// Names of the scenes to play: those asked for, or all of the published figures.
/// @throws Bad_scene  there is none of that name
std::vector<std::string> race_scenes(const Experiment_context& context);

/// One figure of all frames that an entry played.
std::vector<double> values(const Entry_figures& figures, double Frame_seconds::*figure);
double median_of(const Entry_figures& figures, double Frame_seconds::*figure);
/// The least value that 95 % of the values do not exceed.
double percentile_95(std::vector<double> values);

/// Three to four digits; a dash for what was not measured.
std::string milliseconds(double seconds);

}  // namespace lodestone
