// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/files/file_bytes.h"

namespace lodestone {

/// A new folder in the system's place for temporary files; it disappears with this, and all that is in it.
class Temporary_folder {
 public:
  /// @throws Bad_output  it cannot be created, or there is no such place
  Temporary_folder();
  ~Temporary_folder();
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A mesh from the standard input, kept as a file: readers go back and forth in their files. The file disappears with
/// this.
class Standard_input {
 public:
  /// Reads the standard input to its end.
  /// @param format      extension without the dot, such as `obj`
  /// @param most_bytes  that are read
  /// @throws Bad_mesh     it cannot be read, or is longer than `most_bytes`
  /// @throws Bad_output   the temporary file cannot be written
  /// @throws Interrupted  the user has asked to stop
  Standard_input(const std::string& format, std::uintmax_t most_bytes);

  const std::filesystem::path& file() const { return file_; }

 private:
  Temporary_folder folder_;
  std::filesystem::path file_;
};

/// The message of an error, in which the standard input is called so, and not by the path of the file that it was kept
/// in.
std::string naming_standard_input(std::string message);

/// The name of a file without its folders, or `standard input` for the file that it was kept in.
std::string shown_name(const std::filesystem::path& file);

/// Replaces an input that is `-` by the standard input.
/// @param format     of the standard input; empty: not given
/// @param max_bytes  of it
/// @param kept       receives the standard input, which must live as long as it is read
/// @throws Bad_argument  `-` twice or without a format, a format without `-`
void replace_standard_input(std::vector<std::filesystem::path*> inputs, const std::string& format,
                            std::uintmax_t max_bytes, std::optional<Standard_input>& kept);

}  // namespace lodestone
