// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Vertices of the mesh that some faces all have, then `no_shared_vertex`. Around the tip of a cone it is the tip.
using Shared_vertices = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t no_shared_vertex = std::numeric_limits<std::uint32_t>::max();

/// Those of the faces of a leaf.
Shared_vertices shared_vertices(const Tree_layout& layout, std::uint32_t leaf);
/// Those of the faces below each node. O(F).
std::vector<Shared_vertices> shared_vertices_of_nodes(const Tree_layout& layout);

/// Whether there is a vertex in both lists: then each face of the first shares a vertex with each of the second.
bool have_one_in_common(const Shared_vertices& a, const Shared_vertices& b);

}  // namespace lodestone
