// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scenes/scene_folder.h"

#include <fmt/format.h>

#include <system_error>

#include "io/files/inside_folder.h"
#include "lodestone/io/files/numbered_files.h"

namespace lodestone::detail {

namespace {

namespace fs = std::filesystem;

/// `pattern` with its run of # replaced by `number`, zero-padded to the length of the run.
std::string numbered(std::string pattern, std::size_t number) {
  const auto first = pattern.find('#');
  const auto length = pattern.find_last_of('#') + 1 - first;
  return pattern.replace(first, length, fmt::format("{:0{}}", number, length));
}

}  // namespace

fs::path Scene_folder::path_of(const std::string& name, const Json_value& value) {
  std::error_code error;
  const bool inside = is_inside(folder_, name, error);
  if (error) value.fail(fmt::format("{} cannot be followed: {}", as_json(name), error.message()));
  if (!inside && !options_.allow_outside)
    value.fail(
        fmt::format("{} is not inside the scene's folder; the option `allow_outside`, or --allow-outside, allows that",
                    as_json(name)));
  found_.push_back(folder_ / name);
  return found_.back();
}

fs::path Scene_folder::file(const Json_value& value) { return path_of(value.text(), value); }

std::vector<fs::path> Scene_folder::numbered_files(const Json_value& value) {
  value.expect_keys({"pattern", "first", "last"});
  const Json_value pattern = value.at("pattern");
  const std::string name = pattern.text();
  const auto run = name.find('#');
  if (run == name.npos || name.find('#', name.find_first_not_of('#', run)) != name.npos)
    pattern.fail(fmt::format("{} must have one run of # for the number", as_json(name)));
  const std::size_t most = std::max<std::size_t>(limits().max_frames, 1);
  const std::size_t greatest = std::max<std::size_t>(1'000'000, most);
  const std::size_t first = value.at("first").count(0, greatest);
  const std::size_t last = value.at("last").count(first, first + std::min(greatest - first, most - 1));

  std::vector<fs::path> files;
  std::error_code ignored;
  for (std::size_t i = first; i <= last; ++i) {
    files.push_back(path_of(numbered(name, i), pattern));
    // The reader of the sequence will name this file. Those behind it could be a million.
    if (!fs::exists(files.back(), ignored)) break;
  }
  return files;
}

std::vector<fs::path> Scene_folder::files_of_pattern(const Json_value& value) {
  const std::string pattern = value.text();
  const fs::path alone = path_of(pattern, value);
  // A file of that name is meant, as in a command.
  if (std::error_code ignored; is_pattern(alone) && fs::is_regular_file(alone, ignored)) return {alone};
  std::vector<fs::path> files;
  for (const auto& found : value.checked([&] { return find_numbered_files(folder_ / pattern); }))
    files.push_back(path_of((fs::path(pattern).parent_path() / found.filename()).string(), value));
  return files;
}

std::vector<fs::path> Scene_folder::sequence(const Json_value& value) {
  if (value.is_string()) return files_of_pattern(value);
  if (!value.is_array()) return numbered_files(value);
  std::vector<fs::path> files;
  for (const Json_value& element : value.elements(limits().max_frames)) files.push_back(file(element));
  return files;
}

}  // namespace lodestone::detail
