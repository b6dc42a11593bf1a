// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Writes a mesh as binary PLY with the region of each vertex as its colour, and the region's index as property
/// `region`. Regions with consecutive indices get clearly different colours. The file appears whole or not at all.
/// @param regions  per vertex: its region
/// @throws Bad_output
void write_coloured_ply(const std::filesystem::path& file, const Surface_mesh& mesh,
                        const std::vector<Region_index>& regions);
/// The same of arrays.
/// @param coordinates  3 V
/// @param faces        F
/// @param regions      V
void write_coloured_ply(const std::filesystem::path& file, Coordinates coordinates, std::span<const Corners> faces,
                        std::span<const Region_index> regions);

}  // namespace lodestone
