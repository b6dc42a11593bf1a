// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "io/gltf/gltf_container.h"

/// The guard of glTF 2.0: it checks the whole file before tinygltf sees any of it.
namespace lodestone {

/// The result of the guard.
struct Guarded_gltf {
  std::string plain = {};  ///< JSON for tinygltf: only what Lodestone uses. Buffer i has the URI `i`
  std::vector<Bytes> buffers = {};
  std::vector<std::filesystem::path> files = {};  ///< that it is read from
  std::set<std::string> not_read = {};            ///< what else the file holds, such as `texture coordinates`
  std::set<std::string> ignored_extensions = {};  ///< optional ones that say where surfaces are
};

/// Checks every size, index and reference: sizes against the file's contents, indices against counts, types of
/// accessors against their use, nodes for cycles.
/// @param max_bytes  of the file, and of its buffers together
/// @throws Bad_mesh, Bad_scene
Guarded_gltf guard_gltf(const std::filesystem::path& file, std::uintmax_t max_bytes);

}  // namespace lodestone
