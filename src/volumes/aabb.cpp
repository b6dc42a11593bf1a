// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/aabb.h"

#include "volumes/aabb_kernel.h"

namespace lodestone {

void Aabb::enclose(const Leaf_faces& faces) {
  kernel::fit_box(faces.coordinates.data(), faces.vertices.data(), faces.vertices.size(), *this);
}

}  // namespace lodestone
