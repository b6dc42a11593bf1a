// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// The islands of a set of vertices, which are its connected parts: in the order of their lowest vertices, each in
/// ascending order. O(n log n) for n vertices and their edges, whatever V.
/// @param vertices  ascending
/// @param open      V, all false before and after; a buffer, so that a search need not clear it
std::vector<std::vector<std::uint32_t>> islands_of(const Vertex_graph& graph, std::span<const std::uint32_t> vertices,
                                                   std::vector<bool>& open);

}  // namespace lodestone
