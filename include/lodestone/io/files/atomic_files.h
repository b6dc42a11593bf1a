// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "lodestone/io/files/made_folders.h"

namespace lodestone {

/// Files of one folder that appear together once all of them are written, such as one file per frame. Until `commit`
/// they are in a hidden folder inside it.
class Atomic_files {
 public:
  /// Creates the folder if it is missing.
  /// @throws Bad_output  the folder cannot be created
  explicit Atomic_files(const std::filesystem::path& folder);
  Atomic_files(const Atomic_files&) = delete;
  Atomic_files& operator=(const Atomic_files&) = delete;
  /// Without `commit` nothing is left behind.
  ~Atomic_files();

  /// Returns the path to write to. `commit` then renames the file to `name`, a path relative to and inside the folder.
  /// @throws Bad_output  there is something else than a file in its place
  std::filesystem::path add(const std::filesystem::path& name);
  /// Renames the files to their targets in the order of `add`, replacing existing files. Only a rename can fail.
  /// @throws Bad_output
  void commit();

 private:
  std::filesystem::path folder_, hidden_;
  Made_folders made_folders_;
  std::vector<std::filesystem::path> names_;
};

}  // namespace lodestone
