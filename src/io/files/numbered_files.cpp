// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/files/numbered_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view marks = "*#";
constexpr std::string_view all_digits = "0123456789";

struct Pattern {
  std::string before, after;  ///< of the file's name, around the number
  std::size_t width = 0;      ///< minimum number of digits; 0: any
};

Pattern parse(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  const auto first = name.find_first_of(marks);
  const auto last = name.find_last_of(marks);
  const bool one_run = first != name.npos && name.find_first_not_of(name[first], first) > last;
  if (!one_run || (name[first] == '*' && first != last))
    throw Bad_argument(fmt::format("{}: expected one * or one run of # for the number", pattern.string()));
  return {.before = name.substr(0, first),
          .after = name.substr(last + 1),
          .width = name[first] == '*' ? 0 : last + 1 - first};
}

/// Whether the name has something at the place of the number.
bool surrounds_something(const std::string& name, const Pattern& pattern) {
  return name.size() > pattern.before.size() + pattern.after.size() && name.starts_with(pattern.before) &&
         name.ends_with(pattern.after);
}

/// The digits of the number in a file name; nothing if the name does not match the pattern.
std::optional<std::string> digits_of(const std::string& name, const Pattern& pattern) {
  if (!surrounds_something(name, pattern)) return std::nullopt;
  auto number = name.substr(pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
  if (number.find_first_not_of(all_digits) != number.npos) return std::nullopt;
  const bool padded = number.size() == pattern.width || (number.size() > pattern.width && number.front() != '0');
  if (pattern.width > 0 && !padded) return std::nullopt;
  return number;
}

std::size_t value_of(const std::string& number, const fs::path& file) {
  constexpr std::size_t most_digits = 18;  // any number of 18 digits fits into 64 bits
  const auto significant = std::min(number.find_first_not_of('0'), number.size() - 1);
  if (number.size() - significant > most_digits)
    throw Bad_motion(fmt::format("{}: the number in the file's name is too large", file.string()));
  return std::stoull(number.substr(significant));
}

using Numbered = std::map<std::size_t, fs::path>;

void check_no_gap(const Numbered& files, const Pattern& pattern) {
  for (auto file = files.begin(), next = std::next(file); next != files.end(); file = next++) {
    if (next->first == file->first + 1) continue;
    const auto width = digits_of(file->second.filename().string(), pattern)->size();
    const auto missing = fmt::format("{}{:0{}}{}", pattern.before, file->first + 1, width, pattern.after);
    throw Bad_motion(
        fmt::format("{}: there is no such file, but {} and {} exist; where numbers are left out on "
                    "purpose, list the files in a scene, as its `motion.sequence`",
                    (file->second.parent_path() / missing).string(), file->second.filename().string(),
                    next->second.filename().string()));
  }
}

fs::path folder_of(const fs::path& pattern) {
  return pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
}

/// Why a file whose name is that of the pattern but for the number does not count.
std::string reason_against(const std::string& name, const Pattern& pattern) {
  return fmt::format("; {} stands for a whole number{}, which {} does not have there",
                     pattern.width == 0 ? "*" : std::string(pattern.width, '#'),
                     pattern.width == 0 ? "" : fmt::format(" of {} digits, with zeros in front", pattern.width), name);
}

}  // namespace

bool is_pattern(const fs::path& path) { return path.filename().string().find_first_of(marks) != std::string::npos; }

fs::path numbered_file(const fs::path& pattern, std::size_t number) {
  const auto [before, after, width] = parse(pattern);
  return pattern.parent_path() / fmt::format("{}{:0{}}{}", before, number, width, after);
}

std::vector<std::string> names_that_match(const fs::path& pattern) {
  const auto parts = parse(pattern);
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator entries(folder_of(pattern), error); !error && entries != fs::directory_iterator();
       entries.increment(error))
    if (auto name = entries->path().filename().string(); digits_of(name, parts)) names.push_back(std::move(name));
  std::ranges::sort(names);
  return names;
}

std::vector<fs::path> find_numbered_files(const fs::path& pattern) {
  const auto parts = parse(pattern);
  const auto folder = folder_of(pattern);
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) throw Bad_motion(fmt::format("{}: the folder cannot be read: {}", folder.string(), error.message()));

  Numbered files;
  std::string without_number;  // the first name that would match if any text were a number
  for (; entries != fs::directory_iterator(); entries.increment(error)) {
    const auto name = entries->path().filename().string();
    const auto number = digits_of(name, parts);
    if (!number && surrounds_something(name, parts) && (without_number.empty() || name < without_number))
      without_number = name;
    if (!number) continue;
    const auto file = pattern.parent_path() / entries->path().filename();
    const auto [same, is_new] = files.emplace(value_of(*number, file), file);
    if (!is_new) {
      const auto [first, second] = std::minmax(same->second, file);
      throw Bad_motion(fmt::format("{}: has the same number as {}", second.string(), first.filename().string()));
    }
  }
  // An error ends the iteration, too.
  if (error) throw Bad_motion(fmt::format("{}: the folder cannot be read: {}", folder.string(), error.message()));
  if (files.empty())
    throw Bad_motion(fmt::format("{}: no file matches this{}", pattern.string(),
                                 without_number.empty() ? "" : reason_against(without_number, parts)));
  check_no_gap(files, parts);

  std::vector<fs::path> result;
  result.reserve(files.size());
  for (auto& [number, file] : files) result.push_back(std::move(file));
  return result;
}

}  // namespace lodestone
