// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/io/scenes/scene_file.h"

/// Files often hold several things that move apart from each other: a ball and a cloth, the pieces of what breaks.
namespace lodestone {

/// The connected components of an object, each as an object of its own: `NAME_1`, `NAME_2`, ... in the order of their
/// first faces. Faces that share a file vertex are connected. A component has its own file vertices, in the order of
/// those of the whole, and the faces keep their numbers in the file. Where the components ask for one frame one after
/// the other, the whole is posed once.
/// @throws Bad_scene  more than 10 000 components, the most objects of a scene
std::vector<Scene_object> component_objects(const Scene_object& object);

/// Puts the components of each object in its place, if it has several. They are in the same groups and skip what the
/// whole skipped: where it was not to meet itself, they do not meet each other. A name that is taken gets a number.
/// @throws Bad_scene  more than 10 000 objects
void separate_components(Scene& scene);

}  // namespace lodestone
