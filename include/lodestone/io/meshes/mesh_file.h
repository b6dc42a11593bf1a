// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/formats/file_part.h"
#include "lodestone/io/formats/joined_vertices.h"
#include "lodestone/io/formats/mesh_file_options.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// A mesh of triangles as read from a file. Triangles are in the order of the file's faces.
///
/// A face of more than three corners is cut into triangles, which `file_face` maps to it. A quad is cut along the
/// diagonal that suits its shape, or that of its first corner where both suit it alike; a larger face by a Delaunay
/// triangulation inside its outline, so that faces may be concave and need not be planar. They may have holes, to which
/// the outline runs and back along the same two vertices. A face without area, or whose outline crosses itself, or
/// which falls into parts that touch in a corner, is cut into a fan.
///
/// A half-edge mesh cannot represent everything a file can. The reader duplicates a vertex that is on a non-manifold
/// edge, or that one face names twice. It drops vertices that no face uses. `file_vertex` maps mesh vertices to file
/// vertices. Where neighbouring faces of the file have opposite orientations, some are reversed.
///
/// An STL file lists corners instead of vertices: equal corners are one vertex, indexed in order of first appearance.
struct Mesh_file {
  Surface_mesh mesh;                              ///< vertices and faces without removed elements
  std::vector<std::uint32_t> file_vertex;         ///< per mesh vertex: its index in the file
  std::size_t file_vertices = 0;                  ///< number of vertices in the file
  std::vector<std::uint32_t> file_face;           ///< per mesh face: its face in the file; never decreases
  Joined_vertices joined = {};                    ///< vertices of the file: own positions must keep them together
  File_parts parts = {};                          ///< that the file names
  std::set<std::string> ignored_extensions = {};  ///< of glTF: optional ones that say where surfaces are, such as
                                                  ///< EXT_mesh_gpu_instancing; the mesh is that of the file without
  std::vector<std::filesystem::path> files = {};  ///< that it is read from: a glTF file can name others
};

/// Reads a mesh, in the format of the file's extension: OFF, OBJ, PLY (ascii, binary), STL (ascii, binary),
/// glTF 2.0 (.gltf, .glb; at rest), MD2 or MD3 (first frame).
///
/// The file is checked before CGAL's reader sees it: header counts against the file's size, indices against counts,
/// finite coordinates, three corners or more per face, the face limit. Zero-area faces, faces that name a vertex twice,
/// non-manifold edges, duplicate vertices, several components and open borders are legal. Binary OFF and free-form
/// surfaces in OBJ are refused. Cost: linear in the file's size, except at a vertex with very many faces, which CGAL
/// circles once per face.
///
/// @throws Bad_mesh  with file, line (text formats) or byte (binary formats), and cause
Mesh_file read_mesh(const std::filesystem::path& file, const Mesh_file_options& options = {});

/// Builds the same result from points and triangles in memory.
/// @param points  finite
/// @param faces   vertex indices, each below the number of points
/// @param name    used in error messages in place of a file name
/// @throws Bad_mesh
Mesh_file mesh_of(std::span<const Point> points, std::span<const Corners> faces, const std::string& name);

}  // namespace lodestone
