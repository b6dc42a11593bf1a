// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "lodestone/io/formats/mesh_file_options.h"

namespace lodestone {

/// Checks that the first file of a sequence has the faces of the mesh that the sequence moves. Does not read a mesh
/// that is this file.
/// @throws Bad_motion  other faces, a broken file, no such file
void check_first_frame(const std::vector<std::filesystem::path>& files, const std::filesystem::path& mesh,
                       const Mesh_file_options& limits);

}  // namespace lodestone
