// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "shared/experiment.h"

namespace lodestone {

/// What a folder holds to play, in the order of their names:
///  - each scene file `NAME.json`;
///  - each subfolder of real motion: it has at least one mesh `STEM.off` with its point cache `STEM.pc2`, and no scene
///    file. Deeper folders are not searched.
/// @throws Bad_scene  there is no such folder, or nothing in it to play
std::vector<std::filesystem::path> scene_sources(const std::filesystem::path& folder);

/// A sentence for a reader that names the subfolders with files of meshes or motion that are no scene sources; empty if
/// there are none.
/// @throws Bad_scene  there is no such folder
std::string note_of_unplayed_subfolders(const std::filesystem::path& folder);

/// Those of the `scene_sources` of a folder that have these names, in the order of the names.
/// @throws Bad_scene  as scene_sources; a name that nothing in the folder has
std::vector<std::filesystem::path> named_sources(const std::filesystem::path& folder,
                                                 std::span<const std::string> names);

/// The sources that the caller asked for: those named, or all of a folder that is not the project's own.
/// @param otherwise  names of scenes of the project that are played if the caller asked for none
/// @throws Bad_scene  as named_sources
std::vector<std::filesystem::path> chosen_sources(const Experiment_context& context,
                                                  std::span<const std::string> otherwise);

/// What results call a source before it is read: the file's name without its extension, or the name of the folder.
std::string name_of_source(const std::filesystem::path& source);

/// The name, with a number if an earlier scene has it: rows and curves of two scenes must not mix.
/// @param taken  names of scenes so far; has this one's afterwards
std::string untaken(const std::string& wanted, std::set<std::string>& taken);

/// Reads a scene file, or makes a scene of a folder of real motion. That scene has the name of the folder, and an
/// object for each mesh `STEM.off` in the order of the stems; meshes without a point cache do not move. If the scene
/// has a single object, which may collide with itself and has several connected components, these are the objects
/// instead: see `separate`.
/// @throws Bad_scene, Bad_mesh, Bad_motion  as read_scene and scene_of
Scene read_source(const std::filesystem::path& source);

}  // namespace lodestone
