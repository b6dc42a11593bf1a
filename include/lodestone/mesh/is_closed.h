// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Whether every edge, an unordered pair of different vertices, belongs to an even number of faces.
///
/// If a face uses a vertex twice, two of its sides are the same edge and the third is no edge. Such a face does not
/// change the result. That is right, because no ray crosses it. A mesh without faces is closed and has nothing inside.
///
/// O(V + F) plus sorting the edges of each vertex.
/// @param corners  vertex indices, each below `vertex_count`
bool is_closed(std::uint32_t vertex_count, std::span<const Corners> corners);

}  // namespace lodestone
