// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Whether every edge, an unordered pair of vertices, is in an even number of faces. O(V + F) plus sorting the edges of
/// each vertex.
///
/// Of a face with a repeated vertex two edges are the same pair, and one is no edge: it changes nothing, as it should,
/// for no ray crosses it. A mesh without faces is closed, with nothing inside.
/// @param corners  numbers below `vertex_count`
bool is_closed(std::uint32_t vertex_count, std::span<const Corners> corners);

}  // namespace lodestone
