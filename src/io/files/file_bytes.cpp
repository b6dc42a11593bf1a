// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/file_bytes.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "lodestone/mesh/errors.h"

namespace lodestone {

File_bytes::File_bytes(const std::filesystem::path& file, std::uintmax_t max_bytes) : name_(file.string()) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!exists(status)) throw Bad_mesh(fmt::format("{}: there is no such file", name_));
  if (is_directory(status)) throw Bad_mesh(fmt::format("{}: this is a folder, not a file", name_));
  // A pipe or a device could deliver bytes without end.
  if (!is_regular_file(status)) throw Bad_mesh(fmt::format("{}: this is not a regular file", name_));
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw Bad_mesh(fmt::format("{}: the file cannot be read: {}", name_, error.message()));
  if (size == 0) throw Bad_mesh(fmt::format("{}: the file is empty", name_));
  if (size > max_bytes)
    throw Bad_mesh(fmt::format("{}: the file has {} bytes, where at most {} are allowed", name_, size, max_bytes));
  size_ = size;
  bytes_ = std::make_unique_for_overwrite<char[]>(size_);
  read(file);
}

void File_bytes::read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Bad_mesh(fmt::format("{}: the file cannot be read: {}", name_, std::strerror(errno)));
  in.read(bytes_.get(), static_cast<std::streamsize>(size_));
  if (static_cast<std::size_t>(in.gcount()) < size_)
    throw Bad_mesh(fmt::format("{}: the file has become shorter while it was read", name_));
}

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
