// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lodestone {

/// The bytes of a mesh file, as they were when it was read. Not memory-mapped: a mapped file that another process cuts
/// off ends the program.
class File_bytes {
 public:
  /// @param max_bytes  of the file
  /// @throws Bad_mesh  the file does not exist, is a folder, empty, unreadable or longer than `max_bytes`, or has
  ///                   become shorter meanwhile
  File_bytes(const std::filesystem::path& file, std::uintmax_t max_bytes);

  /// The file's name as the user gave it.
  const std::string& name() const { return name_; }
  std::string_view view() const { return {bytes_.get(), size_}; }

  /// @throws Bad_mesh, always: `NAME: byte OFFSET: cause`
  [[noreturn]] void fail_at(std::size_t offset, std::string_view cause) const;

 private:
  void read(const std::filesystem::path& file);

  std::string name_;
  std::size_t size_ = 0;
  std::unique_ptr<char[]> bytes_;
};

/// `text` in quotes, for a one-line message: unprintable characters as `?`, truncated to 40 characters.
std::string in_quotes(std::string_view text);

}  // namespace lodestone
