// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "lodestone/io/formats/joined_vertices.h"
#include "lodestone/io/formats/mesh_file_options.h"

namespace lodestone {

/// A face of a file, which may be cut into triangles.
struct Face_corners {
  std::size_t triangles = 0;
  std::vector<std::size_t> vertices = {};  ///< of the file, in any order, some perhaps several times
};

/// The faces of a mesh that other files move.
struct Moved_faces {
  std::filesystem::path mesh;  ///< its file; empty: a built-in shape
  std::vector<Face_corners> faces;
  Joined_vertices joined;
};

/// Checks that a file of a sequence has the faces of the mesh, in their order: then its vertices most probably are in
/// the order of the mesh, too. Polygons may be cut into triangles in one of both.
/// @throws Bad_motion  other faces, a broken file
void check_faces_of_file(const std::filesystem::path& file, const Moved_faces& moved, const Mesh_file_options& limits);

}  // namespace lodestone
