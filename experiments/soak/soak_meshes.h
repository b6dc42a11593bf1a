// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Triangles that keep their corners while these move.
struct Soak_mesh {
  std::vector<Corners> faces;
  std::vector<Positions> poses;
};

/// A way of making two meshes that are hard to tell apart.
struct Soak_recipe {
  std::string_view name;
  std::array<Soak_mesh, 2> (*make)(std::mt19937_64& random);
};

inline constexpr std::size_t soak_poses = 4;

/// Every recipe: the boxes of the two meshes overlap, coordinates are of the order of 1.
std::vector<Soak_recipe> soak_recipes();

/// Takes all coordinates to the unit, or to the place, of the given number.
inline constexpr std::size_t soak_frames_of_reference = 6;
void move_to_frame_of_reference(Soak_mesh& mesh, std::size_t number);

}  // namespace lodestone
