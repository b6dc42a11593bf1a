// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "lodestone/io/formats/file_part.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Triangles whose vertices move, as read from files.
struct Animation {
  std::string kind;                               ///< mesh, sequence, pc2, mdd, gltf, md2, md3; object: of a scene
  std::size_t vertices = 0;                       ///< number of vertices in the file
  std::vector<Corners> faces = {};                ///< file vertices; empty for a point cache without its mesh
  std::vector<std::uint32_t> file_face = {};      ///< per triangle: its face in the file, as in Mesh_file
  File_parts parts = {};                          ///< that the file with the faces names
  Motion motion = {};                             ///< at least one frame
  double frames_per_second = 0;                   ///< 0: the file does not specify it
  std::set<std::string> not_read = {};            ///< what else the mesh file holds, such as `texture coordinates`
  std::set<std::string> ignored_extensions = {};  ///< as in Mesh_file
  std::vector<std::filesystem::path> files = {};  ///< all files that it is read from
};

/// Options of `read_animation`.
struct Animation_options {
  std::filesystem::path mesh = {};  ///< for a point cache: the mesh file that it moves; empty: positions only
  std::optional<double> frames_per_second = {};  ///< of a glTF animation, as in Gltf_motion_options
  std::variant<std::size_t, std::string> animation = std::size_t{0};  ///< in a glTF file: its index or name
  Mesh_file_options limits = {};                                      ///< of every file that has faces, and of frames
};

/// The two files of `MESH+CACHE`, such as `cloth.obj+cloth.pc2`.
struct Mesh_and_cache {
  std::filesystem::path mesh;   ///< faces, and one position per vertex
  std::filesystem::path cache;  ///< positions per frame
};

/// Splits `MESH+CACHE`; nothing if `input` is not of that form, or is the name of a file.
std::optional<Mesh_and_cache> mesh_and_cache(const std::filesystem::path& input);

/// Reads one of: a mesh file (one frame), a pattern of numbered mesh files, a point cache `.pc2` or `.mdd`, a mesh and
/// its point cache (`MESH+CACHE`), glTF, MD2, MD3. `motion.pose` reads each frame on demand. A pattern
/// that is also the name of a file means that file.
/// @throws Bad_mesh, Bad_motion  a file is missing or broken
/// @throws Bad_argument          `options.mesh` is given, and `input` is not a point cache
Animation read_animation(const std::filesystem::path& input, const Animation_options& options = {});

}  // namespace lodestone
