// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lodestone/mesh/coordinates.h"

namespace lodestone {

/// Refuses a vertex: "vertex 3 of TITLE has a coordinate that is not finite".
/// @param vertex     its index in the mesh
/// @param title      names the object in the message; empty: the message names only the vertex
/// @throws Bad_mesh  always
[[noreturn]] void fail_not_finite(std::uint32_t vertex, std::string_view title = {});

/// Checks that all coordinates are finite. O(V).
/// @param title      as `fail_not_finite`
/// @throws Bad_mesh  one of the coordinates is not finite
void check_finite(Coordinates coordinates, const std::string& title);
/// The same for the coordinates of some vertices.
void check_finite(Coordinates coordinates, std::span<const std::uint32_t> vertices, const std::string& title);

}  // namespace lodestone
