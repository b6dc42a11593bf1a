// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace lodestone::test {

/// What tests/support/read_vtk.py prints about .vtp and .pvd files: one JSON value per file.
inline std::vector<nlohmann::json> read_vtk(const std::vector<std::filesystem::path>& files) {
  std::string command = std::string(LODESTONE_PYTHON) + " " + LODESTONE_TESTS + "/support/read_vtk.py";
  for (const auto& file : files) command += " '" + file.string() + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> bytes{};
  while (const auto count = std::fread(bytes.data(), 1, bytes.size(), pipe)) text.append(bytes.data(), count);
  EXPECT_EQ(::pclose(pipe), 0) << command;
  std::istringstream lines(text);
  std::vector<nlohmann::json> values;
  for (std::string line; std::getline(lines, line);) values.push_back(nlohmann::json::parse(line));
  EXPECT_EQ(values.size(), files.size());
  values.resize(files.size());
  return values;
}

}  // namespace lodestone::test
