// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/aabb.h"

#include <algorithm>

namespace lodestone {

void Aabb::enclose(const Leaf_faces& faces) {
  const double* first = faces.position(0);
  for (int axis = 0; axis < 3; ++axis) low[axis] = high[axis] = first[axis];
  for (std::size_t index = 1; index < faces.vertices.size(); ++index) {
    const double* position = faces.position(index);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], position[axis]);
      high[axis] = std::max(high[axis], position[axis]);
    }
  }
  low[3] = high[3] = 0;
}

}  // namespace lodestone
