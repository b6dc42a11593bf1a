// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/mesh/box.h"

namespace lodestone {

/// Bounding box of points, in one pass over all coordinates. The pass runs at the speed of the memory, or of the vector
/// unit if the coordinates are in a cache. No exact method can spend less time on a frame.
/// @param coordinates  three per point
/// @return empty for no point
Box read_every_vertex(std::span<const double> coordinates);

}  // namespace lodestone
