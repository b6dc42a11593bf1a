// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Triangles whose vertices move, as files hold them.
struct Animation {
  std::string kind;                 ///< mesh, sequence, pc2, mdd, gltf, md2, md3
  std::size_t vertices = 0;         ///< of the file
  std::vector<Corners> faces = {};  ///< vertex numbers of the file; none of a point cache without its mesh
  Motion motion = {};               ///< at least one frame
  double frames_per_second = 0;     ///< 0: the file does not say
};

struct Animation_options {
  std::filesystem::path mesh = {};  ///< of a point cache: the mesh file that it moves; empty: positions alone
  double frames_per_second = 30;    ///< at which a glTF animation is sampled; > 0
  std::variant<std::size_t, std::string> animation = std::size_t{0};  ///< of a glTF file: its number or name
};

/// Reads any of: a mesh file (one frame), a pattern of numbered mesh files, a point cache `.pc2` or `.mdd`, glTF, MD2,
/// MD3. Frames are read as `motion.pose` asks for them.
/// @throws Bad_mesh, Bad_motion  a file that is missing or broken
/// @throws Bad_argument          a mesh for something that is no point cache
Animation read_animation(const std::filesystem::path& input, const Animation_options& options = {});

}  // namespace lodestone
