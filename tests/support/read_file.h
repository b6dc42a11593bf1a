// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lodestone::test {

/// The bytes of a file, which must be there.
std::string read_bytes(const std::filesystem::path& file);

nlohmann::json read_json(const std::filesystem::path& file);

/// One JSON value per line; the file must end with a line break.
std::vector<nlohmann::json> read_json_lines(const std::filesystem::path& file);

/// What tests/support/read_vtk.py prints about .vtp and .pvd files: one JSON value per file.
std::vector<nlohmann::json> read_vtk(const std::vector<std::filesystem::path>& files);

}  // namespace lodestone::test
