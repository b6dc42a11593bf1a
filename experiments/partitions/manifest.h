// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace lodestone {

/// Program and inputs of a sweep: revision of the source, compiler, processors, numbers of regions, seeds, and hashes
/// of the meshes.
nlohmann::ordered_json partition_manifest();

/// @throws Bad_argument  the folder has no manifest, or something else in its place
nlohmann::ordered_json read_manifest(const std::filesystem::path& folder);

/// Checks that the rows of a folder come from the same program and inputs; only the processors may differ.
/// @throws Bad_argument  what differs; as `read_manifest`
void check_manifest(const std::filesystem::path& folder, const nlohmann::ordered_json& manifest);

/// Writes the manifest into a folder of rows. If the folder has one, adds the processors to it.
/// @throws Bad_argument  as `check_manifest`; Bad_output
void write_manifest(const std::filesystem::path& folder, const nlohmann::ordered_json& manifest);

}  // namespace lodestone
