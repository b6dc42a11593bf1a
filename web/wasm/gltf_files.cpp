// SPDX-License-Identifier: GPL-3.0-or-later
// glTF is not read in a browser: its reader is a library that Emscripten does not have.
#include "io/gltf/gltf_scene.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

bool is_gltf(const std::filesystem::path& file) { return file.extension() == ".gltf" || file.extension() == ".glb"; }

std::shared_ptr<const Gltf_scene> read_gltf_scene(const std::filesystem::path& file,
                                                  const Mesh_file_options& /*options*/) {
  throw Bad_mesh(file.string() + ": glTF is not read in a browser: use .off, .obj, .ply or .stl");
}

Polygon_soup soup_of(std::shared_ptr<const Gltf_scene> /*scene*/) { return {}; }

}  // namespace lodestone
