// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// What a glTF file consists of, whether `.gltf` or `.glb`.
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
/// @param max_bytes  of the file
/// @throws Bad_mesh   a broken container, a longer file
/// @throws Bad_scene  broken JSON
Gltf_document read_gltf_document(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// The bytes of every buffer, exactly as many as it announces: from the file itself, from a data URI, or from a file in
/// its folder.
/// @param max_bytes  of all buffers together
/// @throws Bad_mesh, Bad_scene  a buffer is missing, shorter than it announces, or outside the folder; they are longer
std::vector<Bytes> read_gltf_buffers(Gltf_document& document, const std::filesystem::path& folder,
                                     std::uintmax_t max_bytes);

}  // namespace lodestone
