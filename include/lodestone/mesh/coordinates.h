// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace lodestone {

/// Coordinates of all vertices in one frame, by vertex index: x, y, z, x, y, z, ...; 3 V values.
using Coordinates = std::span<const double>;

}  // namespace lodestone
