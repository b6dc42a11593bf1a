// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of files, given an input as the bytes of a file.
#pragma once

#include <filesystem>
#include <string>

#include "fuzz/target.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/motion.h"

namespace lodestone::fuzz {

/// What a mesh from a file must be: valid, finite, and in step with the numbers of the file.
void check_mesh(const Mesh_file& file, const Mesh_file_options& options);

/// Poses the first, the middle and the last frame. Every coordinate must be finite; the positions that are computed one
/// by one must be the same.
void check_motion(const Motion& motion, std::size_t vertices);

/// Reads the input as a mesh in the format of the extension.
void read_as_mesh(Input input, const std::string& extension);

/// Reads the input as a mesh and as an animation.
void read_as_animation(Input input, const std::string& extension);

}  // namespace lodestone::fuzz
