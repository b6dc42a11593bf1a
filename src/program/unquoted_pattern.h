// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

namespace lodestone {

/// Files that a shell may have listed in place of a pattern of numbered files.
struct Unquoted_pattern {
  std::filesystem::path pattern;  ///< with a `*` for the number
  std::size_t inputs = 0;         ///< how many inputs match it
};

/// The pattern that most inputs match, if at least three do, and their numbers follow each other. Counts mesh files
/// whose paths differ only in one number.
std::optional<Unquoted_pattern> find_unquoted_pattern(std::span<const std::filesystem::path> inputs);

}  // namespace lodestone
