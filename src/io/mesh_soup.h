// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lodestone/io/mesh_file.h"

namespace lodestone {

/// Points and triangles as a file lists them: vertex and face numbers are the file's own, from 0.
struct Mesh_soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
};

/// By the file's extension.
bool is_gltf(const std::filesystem::path& file);

/// Reads a mesh file through its guard and CGAL's reader. The corners of an STL file are welded where they are equal;
/// its points are numbered in order of first appearance.
/// @throws Bad_mesh as `read_mesh`
Mesh_soup read_mesh_soup(const std::filesystem::path& file, const Mesh_file_options& options = {});

/// Its faces in a form that takes little memory.
std::vector<Corners> corners_of(const Mesh_soup& soup);

/// As `mesh_of` of points and faces.
Mesh_file mesh_of(const Mesh_soup& soup, const std::string& name);

}  // namespace lodestone
