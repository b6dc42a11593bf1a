// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace lodestone {

/// Files of one folder that appear together, once all of them are written: one per frame, say. Until `commit` they
/// stand in a hidden folder beside their places.
class Atomic_files {
 public:
  /// Creates the folder if it is missing.
  /// @throws Bad_output  it cannot be made
  explicit Atomic_files(std::filesystem::path folder);
  Atomic_files(const Atomic_files&) = delete;
  Atomic_files& operator=(const Atomic_files&) = delete;
  /// Without `commit` nothing is left behind.
  ~Atomic_files();

  /// Where to write the file that will be `name`, relative to the folder and inside it.
  std::filesystem::path add(const std::filesystem::path& name);
  /// Puts the files in place of whatever had their names, in the order of `add`: only a rename can fail now.
  /// @throws Bad_output
  void commit();

 private:
  std::filesystem::path folder_, hidden_;
  std::vector<std::filesystem::path> names_;
};

}  // namespace lodestone
