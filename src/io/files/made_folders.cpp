// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/files/made_folders.h"

#include <algorithm>
#include <system_error>

#include "lodestone/mesh/errors.h"

namespace lodestone {

Made_folders::Made_folders(const std::filesystem::path& folder) {
  std::error_code error;
  auto missing = std::filesystem::absolute(folder, error).lexically_normal();
  while (!error && !std::filesystem::exists(missing, error) && missing.has_relative_path()) {
    if (!missing.filename().empty()) folders_.push_back(missing);
    missing = missing.parent_path();
  }
  std::ranges::reverse(folders_);
  std::filesystem::create_directories(folder, error);
  if (!error) return;
  remove();
  throw Bad_output(folder.string() + ": cannot create the folder: " + error.message());
}

Made_folders::~Made_folders() { remove(); }

void Made_folders::remove() const {
  std::error_code ignored;
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
    if (std::filesystem::is_directory(*folder, ignored)) std::filesystem::remove(*folder, ignored);  // if it is empty
}

}  // namespace lodestone
