// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// An object of a scene that an experiment makes without files. It is at rest, and has no particles of its own.
/// @throws Bad_argument  as `check` of a deformation
Scene_object made_object(std::string name, Surface_mesh mesh, std::vector<Deformation> deformations);

}  // namespace lodestone
