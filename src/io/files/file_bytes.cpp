// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/file_bytes.h"

#include <fmt/format.h>

#include <boost/interprocess/file_mapping.hpp>
#include <system_error>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

boost::interprocess::mapped_region mapped(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  const auto name = file.string();
  if (!exists(status)) throw Bad_mesh(fmt::format("{}: there is no such file", name));
  if (is_directory(status)) throw Bad_mesh(fmt::format("{}: this is a directory, not a mesh file", name));
  // A pipe or a device could deliver bytes without end.
  if (!is_regular_file(status)) throw Bad_mesh(fmt::format("{}: this is not a regular file", name));
  if (std::filesystem::file_size(file, ignored) == 0) throw Bad_mesh(fmt::format("{}: the file is empty", name));
  try {
    const boost::interprocess::file_mapping mapping(name.c_str(), boost::interprocess::read_only);
    return {mapping, boost::interprocess::read_only};
  } catch (const boost::interprocess::interprocess_exception& error) {
    throw Bad_mesh(fmt::format("{}: the file cannot be read: {}", name, error.what()));
  }
}

}  // namespace

File_bytes::File_bytes(const std::filesystem::path& file) : name_(file.string()), region_(mapped(file)) {}

void File_bytes::fail_at(std::size_t offset, std::string_view cause) const {
  throw Bad_mesh(fmt::format("{}: byte {}: {}", name_, offset, cause));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "'";
  for (const char c : text.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
  return result += text.size() > longest ? "...'" : "'";
}

}  // namespace lodestone
