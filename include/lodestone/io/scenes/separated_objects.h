// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/io/scenes/scene_file.h"

/// Files often hold several things that move apart from each other: a ball and a cloth, the pieces of what breaks.
namespace lodestone {

/// Of what objects are made, in the place of an object.
enum class Separate {
  components,  ///< its connected components: faces that share a file vertex are connected
  parts        ///< the parts that its file names, see File_part
};

/// The parts or connected components of an object, each as an object of its own, in the order of their first faces.
/// Components are called `NAME_1`, `NAME_2` and so on; parts have the names that their file gives them, and what
/// belongs to none that of the object. Each has its own file vertices, in the order of those of the whole, and the
/// faces keep their numbers in the file. Where the objects ask for one frame one after the other, the whole is posed
/// once.
/// @throws Bad_scene  more than `max_objects`
std::vector<Scene_object> separated_objects(const Scene_object& object, Separate what,
                                            std::size_t max_objects = Scene_options().max_objects);

/// Puts these in the place of each object that has several, unless it is not to meet itself. They are in the groups of
/// the whole, and its ignored pairs hold for them. Names differ: where `NAME_1` is taken, components of NAME are called
/// `NAME_2_1`, `NAME_2_2` and so on, and a part gets a number.
/// @throws Bad_scene  more than `max_objects` in the scene, or a million ignored pairs
void separate(Scene& scene, Separate what, std::size_t max_objects = Scene_options().max_objects);

}  // namespace lodestone
