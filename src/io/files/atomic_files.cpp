// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/files/atomic_files.h"

#include <unistd.h>

#include <string>
#include <system_error>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace fs = std::filesystem;

Atomic_files::Atomic_files(const fs::path& folder) : folder_(folder.empty() ? "." : folder), made_folders_(folder_) {
  std::error_code error;
  bool made = false;
  for (int attempt = 0; !made && attempt < 100; ++attempt) {
    hidden_ = folder_ / (".new." + std::to_string(::getpid()) + "." + std::to_string(attempt));
    made = fs::create_directory(hidden_, error);
    if (error) break;
  }
  if (error) throw Bad_output(folder_.string() + ": cannot create a folder in it: " + error.message());
  if (!made)
    throw Bad_output(folder_.string() + ": holds a hundred folders .new." + std::to_string(::getpid()) +
                     ".* of runs that were killed: remove them");
}

Atomic_files::~Atomic_files() {
  std::error_code ignored;
  fs::remove_all(hidden_, ignored);
}

Atomic_file Atomic_files::open(const fs::path& name) {
  const fs::path target = folder_ / name;
  check_replaceable(target);
  std::error_code error;
  if (const auto folder = target.parent_path(); fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw Bad_output(folder.string() + ": is not a folder, but files are to be written into it");
  names_.push_back(name);
  return {hidden_ / name, folder_ / name};
}

void Atomic_files::commit() {
  std::error_code error;
  for (const auto& name : names_) {
    const auto target = folder_ / name;
    fs::create_directories(target.parent_path(), error);
    if (!error) fs::rename(hidden_ / name, target, error);
    if (error) throw Bad_output(target.string() + ": cannot be renamed into place: " + error.message());
  }
  names_.clear();
}

}  // namespace lodestone
