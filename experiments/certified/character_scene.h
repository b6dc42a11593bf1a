// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "certified/character.h"

namespace lodestone {

/// Two characters and how they move.
struct Character_scene {
  std::string name;
  std::array<Character, 2> characters;
  std::vector<std::array<Skin_pose, 2>> frames = {};
  bool everything_is_near = false;

  void pose(std::size_t frame) {
    for (std::size_t i = 0; i < 2; ++i) frames[frame][i].give_to(characters[i].points);
  }
};

/// Two characters that touch at a small part in some frames, and nearly touch in others.
///
/// The second faces the first: it is turned by half a turn about z, which is up. In each frame it is moved along x to
/// where the two meet first, and from there by a wave of the frame: farther in by up to 0.6 % of the size of the
/// first, or out again by as much. Each plays its own animation; the second is half an animation ahead.
///
/// @param aside  of the second, along y, in units of the coordinates
Character_scene touching(std::string name, const Character& first, const Character& second, double aside = 0);

/// Two knots of two joints each, which bend and turn through each other.
Character_scene knots_through_each_other();

/// The same scene with characters of about so many triangles each.
Character_scene with_triangles(const Character_scene& scene, std::size_t triangles);

}  // namespace lodestone
