// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/formats/mesh_file_options.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// A mesh as read from a file. Face number i of the mesh is the i-th face of the file.
///
/// A half-edge mesh cannot hold everything a file can: a vertex on a non-manifold edge, or named twice by one face,
/// stands several times in the mesh, and a vertex that no face uses is left out. `file_vertex` keeps the way back.
/// Where neighbouring faces of the file are oriented against each other, some are reversed.
///
/// An STL file lists corners instead of vertices: equal corners are one vertex, numbered in order of first appearance.
struct Mesh_file {
  Surface_mesh mesh;
  std::vector<std::uint32_t> file_vertex;  ///< per mesh vertex: its number in the file, from 0
  std::size_t file_vertices = 0;           ///< number of vertices in the file
};

/// Reads a triangle mesh from OFF, OBJ, PLY (ascii, binary) or STL (ascii, binary), by the file's extension.
///
/// The file is checked before CGAL's reader sees it: header counts against the file's size, indices against counts,
/// finite coordinates, triangles only, the face limit. Zero-area faces, faces that name a vertex twice, non-manifold
/// edges, duplicate vertices, several components and open borders are legal. Binary OFF and free-form surfaces in OBJ
/// are refused. Linear in the file's size but for a vertex of very many faces: CGAL walks around it once per face.
///
/// @throws Bad_mesh with file, line (text formats) or byte (binary formats), and cause
Mesh_file read_mesh(const std::filesystem::path& file, const Mesh_file_options& options = {});

/// The same from points and triangles in memory.
/// @param points  finite
/// @param faces   vertex numbers below the number of points
/// @param name    what error messages call them
/// @throws Bad_mesh
Mesh_file mesh_of(std::span<const Point> points, std::span<const Corners> faces, const std::string& name);

}  // namespace lodestone
