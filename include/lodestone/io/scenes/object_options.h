// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/detection/detector_options.h"
#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// With what a detector takes an object of a scene: its name, its collision groups, which of its vertices are one in
/// the file, where particles of the predecessor start, and how many particles the scene asks for.
Object_options object_options(const Scene_object& object);

}  // namespace lodestone
