// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/files/json_reader.h"
#include "lodestone/io/scenes/scene_file.h"

namespace lodestone::detail {

/// Finds the files that a scene names, relative to the scene's folder, and remembers them.
class Scene_folder {
 public:
  Scene_folder(std::filesystem::path folder, const Scene_options& options)
      : folder_(std::move(folder)), options_(options) {}

  /// The file that `value` names.
  /// @throws Bad_scene  the file is not inside the folder after symbolic links are resolved
  std::filesystem::path file(const Json_value& value);
  /// The files of a sequence: a pattern such as "walk_*.obj", a list of names, or
  /// {"pattern": "walk_####.obj", "first": 1, "last": 40}.
  std::vector<std::filesystem::path> sequence(const Json_value& value);

  const Scene_options& options() const { return options_; }
  /// Limits of the files that have faces.
  const Mesh_file_options& limits() const { return options_.limits; }

  /// The files that were found since the last call.
  std::vector<std::filesystem::path> take_found() { return std::exchange(found_, {}); }

 private:
  std::filesystem::path path_of(const std::string& name, const Json_value& value);
  std::vector<std::filesystem::path> numbered_files(const Json_value& value);
  std::vector<std::filesystem::path> files_of_pattern(const Json_value& value);

  std::filesystem::path folder_;
  Scene_options options_;
  std::vector<std::filesystem::path> found_;
};

}  // namespace lodestone::detail
