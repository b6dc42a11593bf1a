// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lodestone/mesh/coordinates.h"

namespace lodestone {

/// Checks that all coordinates are finite. O(V).
/// @param title      names the object in the message
/// @throws Bad_mesh  one of the coordinates is not finite
void check_finite(Coordinates coordinates, const std::string& title);
/// The same for the coordinates of some vertices.
void check_finite(Coordinates coordinates, std::span<const std::uint32_t> vertices, const std::string& title);

}  // namespace lodestone
