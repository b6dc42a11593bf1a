// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>

namespace lodestone::test {

/// A temporary folder for the files of one test, removed by the destructor.
class Temporary_folder {
 public:
  Temporary_folder() {
    std::random_device random;
    do {
      path_ = std::filesystem::temp_directory_path() / ("lodestone_" + std::to_string(random()));
    } while (!create_directory(path_));
  }
  ~Temporary_folder() {
    std::error_code ignored;
    remove_all(path_, ignored);
  }
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file of exactly these bytes.
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    auto file = path_ / name;
    remove(file);  // overwriting can be slow: some file systems then flush the file to disk
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace lodestone::test
