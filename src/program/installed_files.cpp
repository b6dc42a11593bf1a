// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/installed_files.h"

#include <cstdlib>
#include <system_error>

namespace lodestone {

namespace {

namespace fs = std::filesystem;

fs::path folder_of_program() { return fs::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace

fs::path nearest_above(const fs::path& folder, const fs::path& wanted) {
  std::error_code unreadable;
  for (fs::path place = folder; place.has_relative_path(); place = place.parent_path())
    if (exists(place / wanted, unreadable)) return place / wanted;
  return {};
}

fs::path installed_files() {
  const char* const given = std::getenv("LODESTONE_FILES");
  if (given != nullptr && *given != '\0') return given;
  const fs::path files = fs::path("share") / "lodestone";
  const auto found = nearest_above(folder_of_program(), files);
  return found.empty() ? folder_of_program() / files : found;
}

fs::path experiments_program() {
  const fs::path name = "lodestone-experiments";
  const auto beside = folder_of_program() / name;
  std::error_code unreadable;
  if (exists(beside, unreadable)) return beside;
  const auto found = nearest_above(folder_of_program(), fs::path("lib") / "lodestone" / name);
  return found.empty() ? beside : found;
}

}  // namespace lodestone
