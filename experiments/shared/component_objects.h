// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// The connected components of an object, each as an object of its own: `NAME_1`, `NAME_2`, ... in the order of their
/// first faces. Faces that share a file vertex are connected. All parts have the motion of the whole: their
/// `file_vertex` are indices into its positions.
std::vector<Scene_object> component_objects(const Scene_object& object);

}  // namespace lodestone
