// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Per face the number of its connected component: from 0, in the order of their first faces. Faces that share a vertex
/// are connected. O((V + F) a(V)), a the inverse Ackermann function.
std::vector<std::uint32_t> component_of_faces(std::uint32_t vertex_count, std::span<const Corners> faces);

/// One vertex of each connected component of the faces, in the order of their first faces. The same cost.
std::vector<std::uint32_t> component_vertices(std::uint32_t vertex_count, std::span<const Corners> faces);

}  // namespace lodestone
