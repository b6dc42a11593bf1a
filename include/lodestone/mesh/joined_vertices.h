// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Joins the vertices that have the same file vertex: in the returned faces the lowest of them stands for all.
///
/// O(V log V + F).
/// @param faces        of a mesh of `vertex_count` vertices
/// @param file_vertex  see `Object_options::file_vertex`
/// @return empty if no vertices are joined; the faces are then those of the mesh
/// @throws Bad_argument  `file_vertex` is not empty and does not have one entry per vertex
std::vector<Corners> join_vertices(std::span<const Corners> faces, std::uint32_t vertex_count,
                                   std::span<const std::uint32_t> file_vertex);

/// The vertices that no face uses, ascending. O(V + F).
std::vector<std::uint32_t> unused_vertices(std::span<const Corners> faces, std::uint32_t vertex_count);
/// The same, where the vertices of all faces are listed, each at least once. O(V + their number).
std::vector<std::uint32_t> unused_vertices(std::span<const std::uint32_t> listed, std::uint32_t vertex_count);

}  // namespace lodestone
