// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/detector.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/partition/strategies.h"
#include "program/commands.h"
#include "program/missed_frames.h"

namespace lodestone {

/// A detector of a scene's objects, whose strategy the user names.
using Scene_detector = Detector<Any_strategy>;

/// Whether a run divides surfaces into regions: mode `exact` does only if they are asked for.
bool makes_regions(const Detector_options& options, const Scene& scene);

/// How the particles of a run are made.
Particle_setting particle_setting(const Detect_command& command, const Scene& scene);

}  // namespace lodestone
