// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/detector.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/partition/strategies.h"

namespace lodestone {

/// A detector of a scene's objects, whose strategy the user names.
using Scene_detector = Detector<Any_strategy>;

/// Whether a run divides surfaces into regions: mode `exact` does only if they are asked for.
bool makes_regions(const Detector_options& options, const Scene& scene);

}  // namespace lodestone
