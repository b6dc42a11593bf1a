// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "lodestone/io/files/atomic_file.h"
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

  /// Begins a file in the hidden folder. Its `commit` leaves it there; that of the folder then renames it to `name`, a
  /// path relative to and inside the folder, which is also what its errors call it.
  /// @throws Bad_output  there is something else than a file in its place; it cannot be created
  Atomic_file open(const std::filesystem::path& name);
  /// Renames the files to their targets in the order of `open`, replacing existing files. Only a rename can fail.
  /// @throws Bad_output
  void commit();

 private:
  std::filesystem::path folder_, hidden_;
  Made_folders made_folders_;
  std::vector<std::filesystem::path> names_;
};

}  // namespace lodestone
