// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "lodestone/io/files/made_folders.h"

namespace lodestone {

/// A result replaces files only: no folder, device or pipe.
/// @throws Bad_output  the target is one, or has no name
void check_replaceable(const std::filesystem::path& target);

/// A file that appears whole or not at all: written under a temporary name in the same folder, renamed by `commit`. A
/// symbolic link of that name is replaced, and what it leads to stays as it is: another user may have made the link. A
/// file that is replaced leaves its permissions to the new one.
class Atomic_file {
 public:
  /// Creates the folder if it is missing.
  /// @throws Bad_output  the folder or the file cannot be created, the target is no file
  explicit Atomic_file(const std::filesystem::path& target) : Atomic_file(target, target) {}
  /// @param name  where it is to lie in the end: what errors call it, and whose permissions it takes
  Atomic_file(std::filesystem::path target, std::filesystem::path name);
  Atomic_file(const Atomic_file&) = delete;
  Atomic_file& operator=(const Atomic_file&) = delete;
  /// Without `commit` nothing is left behind.
  ~Atomic_file();

  /// Appends bytes to the file.
  /// @throws Bad_output  the disk is full, or any other error of the system
  void write(std::string_view bytes);
  /// Waits until everything is on disk. Of several files that belong together, finish each before the first `commit`:
  /// after that only a rename can fail.
  /// @throws Bad_output
  void finish();
  /// Finishes, and renames the file to its target, replacing any existing file.
  /// @throws Bad_output
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path target_, name_, temporary_;
  std::optional<Made_folders> made_folders_;
  std::string buffer_;
  int descriptor_ = -1;
};

/// Writes a file that appears whole or not at all. Creates the folder if it is missing.
/// @throws Bad_output  as of Atomic_file
void write_whole(const std::filesystem::path& target, std::string_view bytes);

}  // namespace lodestone
