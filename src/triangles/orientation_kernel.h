// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "triangles/most_planes.h"

namespace lodestone::kernel {

/// Points p, q, r and s. The last index is that of a set of four.
struct Point_quadruples {
  std::size_t count = 0;                  ///< of sets; what follows them is ignored
  double points[4][3][most_planes] = {};  ///< [point][axis]
};

/// Per set the sign of the determinant of q - p, r - p and s - p: 1 or -1, or 0 where it is not proven.
void orientation_signs(const Point_quadruples& sets, double (&signs)[most_planes]);

}  // namespace lodestone::kernel
