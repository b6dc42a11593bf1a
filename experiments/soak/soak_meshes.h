// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Faces whose vertices move from pose to pose.
struct Soak_mesh {
  std::vector<Corners> faces;
  std::vector<Positions> poses;
};

/// A way of making two meshes whose faces are hard to decide on.
struct Soak_recipe {
  std::string_view name;
  std::array<Soak_mesh, 2> (*make)(std::mt19937_64& random);
};

inline constexpr std::size_t soak_poses = 4;

/// Every recipe: the boxes of the two meshes overlap, coordinates are of the order of 1.
std::vector<Soak_recipe> soak_recipes();

/// Scales or translates all coordinates to the frame of reference with the given index.
inline constexpr std::size_t soak_frames_of_reference = 6;
void move_to_frame_of_reference(Soak_mesh& mesh, std::size_t number);

}  // namespace lodestone
