// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// Writes a mesh as binary PLY with a colour per vertex that shows its region, and the region's number as property
/// `region`. Regions with neighbouring numbers get colours far apart. The file appears whole or not at all.
/// @param regions  per vertex
/// @throws Bad_output
void write_coloured_ply(const std::filesystem::path& file, const Surface_mesh& mesh,
                        const std::vector<Region_index>& regions);

}  // namespace lodestone
