// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lodestone {

/// Bytes of a mesh file at most: enough for 50 million faces as text.
inline constexpr std::uintmax_t longest_mesh_file = std::uintmax_t{16} << 30U;

/// The bytes of a mesh file, as they were when it was read. Not memory-mapped: a mapped file that another process cuts
/// off ends the program.
class File_bytes {
 public:
  /// @throws Bad_mesh  the file does not exist, is a folder, empty, unreadable or longer than
  ///                   `longest_mesh_file`, or has become shorter meanwhile
  explicit File_bytes(const std::filesystem::path& file);

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
