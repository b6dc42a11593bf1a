// SPDX-License-Identifier: GPL-3.0-or-later
// Distances along the edges of a mesh by the simplest method.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// Distances from one vertex along the edges: every edge is relaxed until nothing changes.
std::vector<double> plain_distances(const Vertex_graph& graph, const Positions& positions, std::uint32_t source);

std::vector<double> plain_distances_to_nearest(const Vertex_graph& graph, const Positions& positions,
                                               const std::vector<std::uint32_t>& sources);

}  // namespace lodestone
