// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

/// Files that belong to the program. They are found from where the program lies, so that an installation, and a folder
/// with a build, can be moved as a whole.
namespace lodestone {

/// The first of `wanted` in `folder`, in the folder above it, and so on; empty if there is none. The root is left out:
/// its `lib` is that of the system's own programs.
/// @param folder  absolute
std::filesystem::path nearest_above(const std::filesystem::path& folder, const std::filesystem::path& wanted);

/// The folder with `scenes`, `characters` and `experiments`: $LODESTONE_FILES if that is set, else the nearest
/// `share/lodestone` in a folder above the program. In a build folder it holds links into the source.
/// @return the folder beside the program, which need not exist, if there is none: messages then name what is missing
std::filesystem::path installed_files();

/// The program of the experiments: beside this one, else the nearest `lib/lodestone/lodestone-experiments` in a folder
/// above it.
/// @return the file beside this program, which need not exist, if there is none
std::filesystem::path experiments_program();

}  // namespace lodestone
