// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/interprocess/mapped_region.hpp>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace lodestone {

/// The bytes of a mesh file. Memory-mapped: a huge file costs nothing before it is checked.
class File_bytes {
 public:
  /// @throws Bad_mesh  the file does not exist, or is a directory, empty or unreadable
  explicit File_bytes(const std::filesystem::path& file);

  /// The file's name as the user gave it.
  const std::string& name() const { return name_; }
  std::string_view view() const { return {static_cast<const char*>(region_.get_address()), region_.get_size()}; }

  /// @throws Bad_mesh, always: `NAME: byte OFFSET: cause`
  [[noreturn]] void fail_at(std::size_t offset, std::string_view cause) const;

 private:
  std::string name_;
  boost::interprocess::mapped_region region_;
};

/// `text` in quotes, for a one-line message: unprintable characters as `?`, truncated to 40 characters.
std::string in_quotes(std::string_view text);

}  // namespace lodestone
