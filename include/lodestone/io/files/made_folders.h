// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace lodestone {

/// The folders that had to be made for an output. A run that fails or is interrupted leaves none of them behind.
class Made_folders {
 public:
  /// Makes a folder and its missing parents.
  /// @throws Bad_output  one of them cannot be made
  explicit Made_folders(const std::filesystem::path& folder);
  Made_folders(const Made_folders&) = delete;
  Made_folders& operator=(const Made_folders&) = delete;
  /// Removes those that it made and that are empty.
  ~Made_folders();

 private:
  void remove() const;

  std::vector<std::filesystem::path> folders_;  ///< outermost first
};

}  // namespace lodestone
