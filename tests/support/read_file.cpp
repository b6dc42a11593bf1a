// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

namespace lodestone::test {

namespace {

std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::istringstream lines(text);
  std::vector<nlohmann::json> values;
  for (std::string line; std::getline(lines, line);) values.push_back(nlohmann::json::parse(line));
  return values;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

nlohmann::json read_json(const std::filesystem::path& file) { return nlohmann::json::parse(read_bytes(file)); }

std::vector<nlohmann::json> read_json_lines(const std::filesystem::path& file) {
  const std::string text = read_bytes(file);
  EXPECT_TRUE(text.ends_with('\n')) << file;
  return json_lines(text);
}

std::vector<nlohmann::json> read_vtk(const std::vector<std::filesystem::path>& files) {
  std::string command = std::string(LODESTONE_PYTHON) + " " + LODESTONE_TESTS + "/support/read_vtk.py";
  for (const auto& file : files) command += " '" + file.string() + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> bytes{};
  while (const auto count = std::fread(bytes.data(), 1, bytes.size(), pipe)) text.append(bytes.data(), count);
  EXPECT_EQ(::pclose(pipe), 0) << command;
  auto values = json_lines(text);
  EXPECT_EQ(values.size(), files.size());
  values.resize(files.size());
  return values;
}

}  // namespace lodestone::test
