// SPDX-License-Identifier: GPL-3.0-or-later
// A place for the files that a target makes of its input.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "fuzz/target.h"

namespace lodestone::fuzz {

/// A folder in memory where there is one, else a temporary one. Removed at the end of the process.
class Scratch_folder {
 public:
  Scratch_folder() {
    namespace fs = std::filesystem;
    const fs::path memory = "/dev/shm";
    std::error_code ignored;
    const auto parent = ::access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path();
    path_ = parent / ("lodestone_fuzz_" + std::to_string(::getpid()));
    fs::remove_all(path_, ignored);
    fs::create_directory(path_);
  }
  ~Scratch_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch_folder(const Scratch_folder&) = delete;
  Scratch_folder& operator=(const Scratch_folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file of exactly these bytes.
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    auto file = path_ / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  }
  std::filesystem::path write(const std::string& name, Input bytes) const {
    return write(name, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }

 private:
  std::filesystem::path path_;
};

/// The folder of this process.
inline const Scratch_folder& scratch() {
  static const Scratch_folder folder;
  return folder;
}

}  // namespace lodestone::fuzz
