// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "io/formats/mesh_soup.h"
#include "lodestone/io/meshes/mesh_file.h"

namespace lodestone {

/// Reads a mesh file of any format through its guard and CGAL's reader. Equal corners of an STL file are welded, and
/// its points are in order of first appearance.
/// @throws Bad_mesh  as `read_mesh`
Polygon_soup read_polygon_soup(const std::filesystem::path& file, const Mesh_file_options& options = {});

/// The same in triangles.
Mesh_soup read_mesh_soup(const std::filesystem::path& file, const Mesh_file_options& options = {});

/// As `mesh_of` for points and faces.
Mesh_file mesh_of(const Mesh_soup& soup, const std::string& name);

}  // namespace lodestone
