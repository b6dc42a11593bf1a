// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// The faces with vertices of one file number taken as one, the first of them; empty if no number stands twice, so
/// that they are those of the mesh. O(V log V + F).
/// @param faces        of a mesh of `vertex_count` vertices
/// @param file_vertex  see `Object_options::file_vertex`
/// @throws Bad_argument  neither empty nor a number for each vertex
std::vector<Corners> join_vertices(std::span<const Corners> faces, std::uint32_t vertex_count,
                                   std::span<const std::uint32_t> file_vertex);

/// The vertices that no face has, ascending. O(V + F).
std::vector<std::uint32_t> unused_vertices(std::span<const Corners> faces, std::uint32_t vertex_count);

}  // namespace lodestone
