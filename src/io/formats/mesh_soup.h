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
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Points and faces in the order of the file: vertex and face indices are those of the file, from 0.
struct Polygon_soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;  ///< of three corners or more
  Joined_vertices joined = {};
  File_parts parts = {};                          ///< that the file names
  std::set<std::string> not_read = {};            ///< what else the file holds, such as `texture coordinates`
  std::set<std::string> ignored_extensions = {};  ///< optional ones of glTF that say where surfaces are
  std::vector<std::filesystem::path> files = {};  ///< that it is read from
};

/// The same surface in triangles. Those of one face of the file are consecutive.
struct Mesh_soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
  std::vector<std::uint32_t> file_face;  ///< per triangle: its face in the file; never decreases
  Joined_vertices joined = {};
  File_parts parts = {};
  std::set<std::string> not_read = {};
  std::set<std::string> ignored_extensions = {};
  std::vector<std::filesystem::path> files = {};
};

/// Vertices that no face uses are not joined: they are lost in any case.
/// @param first_of  per vertex: the first that is always at its place
/// @param faces     before first vertices are put in the place of others
Joined_vertices joined_of(std::span<const std::uint32_t> first_of, std::span<const Corners> faces);

/// The faces of a soup in compact form.
std::vector<Corners> corners_of(const Mesh_soup& soup);

}  // namespace lodestone
