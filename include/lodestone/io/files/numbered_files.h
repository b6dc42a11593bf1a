// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

/// One file per frame, told apart by a number in the name.
///
/// A pattern is a path whose last part holds either one `*`, which stands for a number written in any way, or one run
/// of `#`, which stands for a number with zeros in front to the length of the run.
namespace lodestone {

/// Whether the last part of `path` holds a `*` or a `#`.
bool is_pattern(const std::filesystem::path& path);

/// The file that a pattern with `#` names for a number; a `*` is replaced by the number as it is.
/// @throws Bad_argument  no pattern
std::filesystem::path numbered_file(const std::filesystem::path& pattern, std::size_t number);

/// All files of a pattern in the order of their numbers: 2 before 10. Names with something else in the number's place
/// are passed over.
/// @throws Bad_argument  no pattern
/// @throws Bad_motion    no folder, no file, two files with one number, a number missing between the first and the last
std::vector<std::filesystem::path> find_numbered_files(const std::filesystem::path& pattern);

}  // namespace lodestone
