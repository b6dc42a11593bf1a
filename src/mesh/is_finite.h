// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

inline bool is_finite(const Point& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); }

}  // namespace lodestone
