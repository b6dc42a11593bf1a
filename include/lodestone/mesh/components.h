// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// One vertex of each connected component of the faces, in the order of the faces. O((V + F) a(V)), a the inverse
/// Ackermann function.
std::vector<std::uint32_t> component_vertices(std::uint32_t vertex_count, std::span<const Corners> faces);

}  // namespace lodestone
