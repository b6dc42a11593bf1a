// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/unquoted_pattern.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "io/files/small_text.h"

namespace lodestone {

namespace {

constexpr std::size_t fewest_frames = 3;
constexpr std::string_view decimal_digits = "0123456789";

/// Other formats hold their frames in one file.
bool has_one_frame(const std::filesystem::path& input) {
  constexpr std::array<std::string_view, 4> extensions{".obj", ".off", ".ply", ".stl"};
  std::error_code ignored;
  return std::ranges::find(extensions, lower_case(input.extension().string())) != extensions.end() &&
         std::filesystem::is_regular_file(input, ignored);
}

/// A pattern of numbered files may leave out no number.
bool has_gap(const std::set<std::string>& numbers) {
  std::set<std::uint64_t> values;
  for (const auto& number : numbers) {
    std::uint64_t value = 0;
    if (std::from_chars(number.data(), number.data() + number.size(), value).ec != std::errc()) return true;
    values.insert(value);
  }
  return values.size() < numbers.size() || *values.rbegin() - *values.begin() != values.size() - 1;
}

}  // namespace

std::optional<Unquoted_pattern> find_unquoted_pattern(std::span<const std::filesystem::path> inputs) {
  std::map<std::filesystem::path, std::set<std::string>> numbers;  // per pattern
  for (const auto& input : inputs) {
    if (!has_one_frame(input)) continue;
    const std::string name = input.filename().string();
    for (std::size_t end = 0, first; (first = name.find_first_of(decimal_digits, end)) != name.npos;) {
      end = std::min(name.find_first_not_of(decimal_digits, first), name.size());
      numbers[input.parent_path() / (name.substr(0, first) + "*" + name.substr(end))].insert(
          name.substr(first, end - first));
    }
  }
  const auto most = std::ranges::max_element(numbers, {}, [](const auto& entry) { return entry.second.size(); });
  if (most == numbers.end() || most->second.size() < fewest_frames || has_gap(most->second)) return std::nullopt;
  return Unquoted_pattern{.pattern = most->first, .inputs = most->second.size()};
}

}  // namespace lodestone
