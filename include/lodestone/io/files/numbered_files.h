// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// One file per frame, numbered in the name.
///
/// A pattern is a path whose file name has either one `*` or one run of `#`. A `*` matches a number with any number of
/// leading zeros. A run of `#` matches a number zero-padded to the length of the run.
namespace lodestone {

/// Whether the file name of `path` has a `*` or a `#`.
bool is_pattern(const std::filesystem::path& path);

/// The file of a pattern for one number. A `*` is replaced by the number without padding.
/// @throws Bad_argument  not a pattern
std::filesystem::path numbered_file(const std::filesystem::path& pattern, std::size_t number);

/// All files of a pattern in the order of their numbers: 2 before 10. Names that match the pattern except for the
/// number are skipped.
/// @throws Bad_argument  not a pattern
/// @throws Bad_motion    no such folder, no matching file, two files with the same number, a number missing between the
///                       first and the last
std::vector<std::filesystem::path> find_numbered_files(const std::filesystem::path& pattern);

/// The names of all files of a pattern, without their folder, sorted. Numbers may be missing, and several names may
/// have the same number. None if the folder cannot be read.
/// @throws Bad_argument  not a pattern
std::vector<std::string> names_that_match(const std::filesystem::path& pattern);

}  // namespace lodestone
