// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/scenes/scene_file.h"

/// Objects of a scene, so far without name, motion and files.
namespace lodestone::detail {

/// The mesh of a file.
Scene_object object_of(Mesh_file&& file);

/// A mesh that no file describes: its own vertices and faces stand for those of a file.
Scene_object object_of(Surface_mesh&& shape);

}  // namespace lodestone::detail
