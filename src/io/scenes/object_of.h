// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/scenes/scene_file.h"

/// From meshes to objects of a scene, which have no name, motion and files so far, and back to faces of files.
namespace lodestone::detail {

/// The mesh of a file.
Scene_object object_of(Mesh_file&& file);

/// A mesh that no file describes: its own vertices and faces stand for those of a file.
Scene_object object_of(Surface_mesh&& shape);

/// The corners of all faces of an object, by file vertex.
std::vector<Corners> file_corners(const Scene_object& object);

}  // namespace lodestone::detail
