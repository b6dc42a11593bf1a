// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiny_gltf.h>
#include <string>

#include "lodestone/io/formats/mesh_file_options.h"

namespace lodestone {

/// Refuses a file whose animations and shown meshes together have too many numbers to keep, before any are read. Many
/// parts of a file can refer to one accessor, so a short file can describe more numbers than fit into memory.
/// @throws Bad_mesh  more than 20 numbers for each face that is allowed, and more than a million
void check_gltf_size(const tinygltf::Model& model, const std::string& name, const Mesh_file_options& options);

}  // namespace lodestone
