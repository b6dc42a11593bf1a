// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// V x 3, in the order of the vertices.
Positions positions_of(const Surface_mesh& mesh);
/// Moves the vertices to positions that `positions_of` gave for the same mesh.
void move_to(const Positions& positions, Surface_mesh& mesh);

/// Where the vertices of each object are in a frame. The meshes stay as they are.
/// @throws Bad_motion  as `pose`
std::vector<Positions> positions_in(Scene& scene, std::size_t frame);

}  // namespace lodestone
