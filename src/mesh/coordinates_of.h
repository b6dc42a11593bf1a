// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// The coordinates of points, one after the other: 3 V. O(V).
inline std::vector<double> coordinates_of(std::span<const Point> points) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Point& p : points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  return coordinates;
}

}  // namespace lodestone
