// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/files/json_reader.h"

/// The guard of glTF 2.0: it understands the whole file before tinygltf may see any of it.
namespace lodestone {

using Bytes = std::vector<unsigned char>;

/// The JSON of a glTF file, and of a `.glb` the bytes behind it.
struct Gltf_document {
  std::string name = {};     ///< of the file, for messages
  nlohmann::json json = {};  ///< an object
  bool has_binary = false;
  Bytes binary = {};
};

/// Takes a `.gltf` or `.glb` apart, by how it begins.
/// @throws Bad_mesh   a broken container
/// @throws Bad_scene  broken JSON
Gltf_document read_gltf_document(const std::filesystem::path& file);

/// The bytes of every buffer, exactly as many as it announces: from the file itself, from a data URI, or from a file in
/// its folder.
/// @throws Bad_mesh, Bad_scene  a buffer that is not there, is shorter than it says, or lies elsewhere
std::vector<Bytes> read_gltf_buffers(Gltf_document& document, const std::filesystem::path& folder);

/// What a guard has found in a file.
struct Guarded_gltf {
  std::string plain = {};  ///< JSON for tinygltf: what Lodestone uses, nothing else. Buffer i has the URI `i`
  std::vector<Bytes> buffers = {};
};

/// Checks every number that something else is counted or looked up by: sizes against what the file holds, indices
/// against counts, types of accessors against their use, nodes against circles.
/// @throws Bad_mesh, Bad_scene
Guarded_gltf guard_gltf(const std::filesystem::path& file);

}  // namespace lodestone
