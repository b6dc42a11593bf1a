// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "io/files/json_reader.h"

/// The guard of glTF 2.0: it checks the whole file before tinygltf sees any of it.
namespace lodestone {

using Bytes = std::vector<unsigned char>;

/// The JSON of a glTF file, and the binary chunk of a `.glb`.
struct Gltf_document {
  std::string name = {};     ///< file name, for messages
  nlohmann::json json = {};  ///< an object
  bool has_binary = false;
  Bytes binary = {};
  std::vector<std::filesystem::path> files = {};  ///< that it is read from
};

/// Splits a `.gltf` or `.glb` file, told apart by its first bytes.
/// @throws Bad_mesh   a broken container
/// @throws Bad_scene  broken JSON
Gltf_document read_gltf_document(const std::filesystem::path& file);

/// The bytes of every buffer, exactly as many as it announces: from the file itself, from a data URI, or from a file in
/// its folder.
/// @throws Bad_mesh, Bad_scene  a buffer is missing, shorter than it announces, or outside the folder
std::vector<Bytes> read_gltf_buffers(Gltf_document& document, const std::filesystem::path& folder);

/// The result of the guard.
struct Guarded_gltf {
  std::string plain = {};  ///< JSON for tinygltf: only what Lodestone uses. Buffer i has the URI `i`
  std::vector<Bytes> buffers = {};
  std::vector<std::filesystem::path> files = {};  ///< that it is read from
  std::set<std::string> not_read = {};            ///< what else the file holds, such as `texture coordinates`
};

/// Checks every size, index and reference: sizes against the file's contents, indices against counts, types of
/// accessors against their use, nodes for cycles.
/// @throws Bad_mesh, Bad_scene
Guarded_gltf guard_gltf(const std::filesystem::path& file);

}  // namespace lodestone
