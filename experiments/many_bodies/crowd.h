// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// A scene of spheres and torus knots of 1280 to 4800 triangles, half of them each. They wobble, spin and drift on
/// closed paths in a cube of side `side_of_crowd`. The same arguments give the same scene.
/// @param bodies  at least 3
/// @param frames  how many of the 240 frames of a path are played
Scene crowd(std::size_t bodies, std::size_t frames);

/// Side of the cube in which a body that is placed at random has on average 1.3 others nearer than 1.5, from centre to
/// centre. It grows a little slower than the cube root of the number: in a small cube more bodies are near a wall,
/// where there are fewer others.
/// @param bodies         at least 3
/// @throws Bad_argument  fewer bodies
double side_of_crowd(std::size_t bodies);

}  // namespace lodestone
